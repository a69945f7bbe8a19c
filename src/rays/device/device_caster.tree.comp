#version 460
#include "rays/device/device_caster.shared.h"

// Traces rays against the triangles of a scene, on any device.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CastParams p; };
#include "rays/device/trace.tree.glsl"
layout(scalar) readonly buffer Rays { CastRay rays[]; };
layout(scalar) writeonly buffer Hits { CastHit hits[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.rays)
        return;
    hits[i] = trace(rays[i], p.wanted, p.solid);
}
