#ifndef LUMEL_LOBES_LOBES_GLSL
#define LUMEL_LOBES_LOBES_GLSL

// Lobes of shooters. Declares `lobes_sent`.

#include "methods/glossy/lobes.shared.h"
#include "methods/glossy/phong.lobe.glsl"

layout(scalar) readonly buffer Lobes { GlossyLobe lobes_sent[]; };  // [K][kMaxLobes]

// Light of shooter k's lobes, with this shininess, along a unit direction: radiance × A_j / (p_j
// K).
vec3 lobes_toward(uint k, GlossyShot shot, Eye eye, vec3 direction, float shininess)
{
    vec3 sum = vec3(0.0);
    for (uint l = 0u; l < shot.lobes; ++l) {
        const GlossyLobe lobe = lobes_sent[k * kMaxLobes + l];
        sum += lobe.specular * phong_lobe(lobe.toward, direction, eye.normal, shininess);
    }
    return sum;
}

#endif
