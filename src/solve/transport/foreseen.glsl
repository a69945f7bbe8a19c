#ifndef LUMEL_TRANSPORT_FORESEEN_GLSL
#define LUMEL_TRANSPORT_FORESEEN_GLSL

// Light that a lumel sends next. Declares `ambient` of the previous batch.

#include "solve/transport/unshot.glsl"

layout(scalar) readonly buffer Ambient { vec3 ambient; };

// Unshot light, plus the expected reflection of light that will still arrive: overshooting [FP92].
// At most the light reflected so far, so that unlit lumels stay dark.
vec3 foreseen(uint j)
{
    const vec3 reflected = abs(surface[j].rgb * (far[j] + near[j]));
    return unshot_of(j) + clamp(surface[j].rgb * ambient, -reflected, reflected);
}

#endif
