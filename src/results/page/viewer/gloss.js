// Gloss of materials, which nothing shows: pages have no environment maps.

/** Leaves the reflection of an environment out of a shader of three.js: it would add 0 to each pixel. */
export function leaveOutGloss(shader) {
    shader.fragmentShader = shader.fragmentShader.replace('#include <lights_physical_fragment>',
        '#undef RE_IndirectSpecular\n#include <lights_physical_fragment>');
}
