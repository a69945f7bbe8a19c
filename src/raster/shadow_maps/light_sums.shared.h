#ifndef LUMEL_RASTER_SHADOW_MAPS_LIGHT_SUMS_SHARED_H
#define LUMEL_RASTER_SHADOW_MAPS_LIGHT_SUMS_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kLightSumsGroup = 64u;  ///< threads per workgroup of light_sums.finish.comp

/// Light of one source received by a lumel so far [lx]. A view decides occlusion only for lumels
/// hit by one of its rays, which has a probability P. Therefore three sums are kept; H = U N / D is
/// exact wherever nothing or everything is occluded.
struct LightSums {
    vec3 open;     ///< U: unoccluded
    vec3 known;    ///< D: unoccluded, if V is known, over P: U on average
    vec3 arrived;  ///< N: part of D that arrives
};

/// Push constants of light_sums.finish.comp.
struct FinishLightParams {
    uint count;  ///< number of lumels
};

LUMEL_SHARED_END
#endif
