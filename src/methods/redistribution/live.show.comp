#version 460
#include "base/core/dispatch.shared.h"
#include "atlas/packing/lumel.shared.h"

// Writes the irradiance of lumels, and texels of the atlas from it. Backs of double-sided surfaces
// share their texels with the fronts, which are shown.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(scalar) readonly buffer Far { vec3 far[]; };
layout(scalar) readonly buffer Near { vec3 near[]; };
layout(scalar) writeonly buffer Shown { vec3 shown[]; };
layout(scalar) writeonly buffer Texels { vec4 texels[]; };
layout(scalar) readonly buffer Direct { vec3 direct[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    const vec3 irradiance = far[i] + near[i] + direct[i];
    shown[i] = irradiance;
    if ((lumels[i].flags & kLumelBack) == 0u)
        texels[lumels[i].texel] = vec4(irradiance, 1.0);
}
