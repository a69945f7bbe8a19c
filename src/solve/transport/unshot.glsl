#ifndef LUMEL_TRANSPORT_UNSHOT_GLSL
#define LUMEL_TRANSPORT_UNSHOT_GLSL

// Light that a lumel has not shot yet. Declares the lumels' light: `surface`, `emission`, `far`,
// `near` and `shot`.

#include "base/core/shared.h"

layout(scalar) readonly buffer Surface { vec4 surface[]; };  // ρ, A
layout(scalar) readonly buffer Emission { vec3 emission[]; };
layout(scalar) readonly buffer Far { vec3 far[]; };
layout(scalar) readonly buffer Near { vec3 near[]; };
layout(scalar) readonly buffer Sent { vec3 shot[]; };

// B_i - B_i^s = E + ρ H - B^s
vec3 unshot_of(uint i)
{
    return emission[i] + surface[i].rgb * (far[i] + near[i]) - shot[i];
}

#endif
