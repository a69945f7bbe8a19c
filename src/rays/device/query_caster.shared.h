#ifndef LUMEL_RAYS_DEVICE_QUERY_CASTER_SHARED_H
#define LUMEL_RAYS_DEVICE_QUERY_CASTER_SHARED_H
#include "base/core/dispatch.shared.h"
LUMEL_SHARED_BEGIN

// Query modes.
LUMEL_CONST uint kNearestOfAll = 0u;
LUMEL_CONST uint kAnySolid = 1u;         ///< any hit, for occlusion
LUMEL_CONST uint kNearestPassable = 2u;  ///< closest surface that may transmit light

LUMEL_CONST uint kNoTriangle = 0xffffffffu;

struct CastRay {
    vec3 origin;  ///< [m]
    float near;   ///< [m]
    vec3 direction;
    float far;  ///< [m]
};

struct CastHit {
    uint triangle;     ///< kNoTriangle: no hit. Transmitting triangles follow the solid ones.
    float distance;    ///< [m]
    vec2 barycentric;  ///< weights of its 2nd and 3rd vertex
};

/// Push constants of query_caster.cast.comp.
struct CastParams {
    uint rays;
    uint wanted;
    uint solid;  ///< number of solid triangles
};

LUMEL_SHARED_END
#endif
