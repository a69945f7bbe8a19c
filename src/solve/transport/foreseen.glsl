#ifndef LUMEL_TRANSPORT_FORESEEN_GLSL
#define LUMEL_TRANSPORT_FORESEEN_GLSL

// Light that a lumel sends next. Declares `ambient`, of the batch before.

#include "solve/transport/unshot.glsl"

layout(scalar) readonly buffer Ambient { vec3 ambient; };

// Unshot light, and what will be reflected of light that is still to arrive: overshooting [FP92].
// Never more than was reflected so far, so that what no light reaches stays dark.
vec3 foreseen(uint j)
{
    const vec3 reflected = abs(surface[j].rgb * (far[j] + near[j]));
    return unshot_of(j) + clamp(surface[j].rgb * ambient, -reflected, reflected);
}

#endif
