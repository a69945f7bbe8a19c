#version 460
#extension GL_EXT_ray_query : require
#include "rays/device/device_caster.shared.h"

// Traces rays against the triangles of a scene. Geometry 0 is solid, geometry 1 may transmit light;
// the caller decides which rays it transmits.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CastParams p; };
uniform accelerationStructureEXT triangles;
layout(scalar) readonly buffer Rays { CastRay rays[]; };
layout(scalar) writeonly buffer Hits { CastHit hits[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.rays)
        return;
    const CastRay ray = rays[i];
    const uint any_mask = 0xffu;
    rayQueryEXT query;
    const uint flags =
        p.wanted == kNearest ? gl_RayFlagsOpaqueEXT : gl_RayFlagsTerminateOnFirstHitEXT;
    rayQueryInitializeEXT(query, triangles, flags, any_mask, ray.origin, ray.near, ray.direction,
                          ray.far);
    uint passable = kNoTriangle;
    while (rayQueryProceedEXT(query))
        passable = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)) + p.solid;
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) {
        hits[i] = CastHit(passable, ray.far, vec2(0.0));
        return;
    }
    const bool solid = rayQueryGetIntersectionGeometryIndexEXT(query, true) == 0;
    hits[i] = CastHit(uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true)) +
                          (solid ? 0u : p.solid),
                      rayQueryGetIntersectionTEXT(query, true),
                      rayQueryGetIntersectionBarycentricsEXT(query, true));
}
