#ifndef LUMEL_RAYS_DEVICE_QUERY_CASTER_SHARED_H
#define LUMEL_RAYS_DEVICE_QUERY_CASTER_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kCastGroup = 64u;

// What rays look for.
LUMEL_CONST uint kNearestOfAll = 0u;
LUMEL_CONST uint kAnySolid = 1u;         ///< whether there is any; which one is left open
LUMEL_CONST uint kNearestPassable = 2u;  ///< among surfaces that may let light pass

LUMEL_CONST uint kNoTriangle = 0xffffffffu;

struct CastRay {
    vec3 origin;  ///< [m]
    float near;   ///< [m]
    vec3 direction;
    float far;  ///< [m]
};

struct CastHit {
    uint triangle;     ///< kNoTriangle: there is none. Passable ones come after the solid ones.
    float distance;    ///< [m]
    vec2 barycentric;  ///< weights of its 2nd and 3rd vertex
};

/// Push constants of query_caster.cast.comp.
struct CastParams {
    uint rays;
    uint wanted;
    uint solid;  ///< triangles
};

LUMEL_SHARED_END
#endif
