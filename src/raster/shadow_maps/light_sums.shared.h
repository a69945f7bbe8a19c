#ifndef LUMEL_RASTER_SHADOW_MAPS_LIGHT_SUMS_SHARED_H
#define LUMEL_RASTER_SHADOW_MAPS_LIGHT_SUMS_SHARED_H
#include "base/core/dispatch.shared.h"
LUMEL_SHARED_BEGIN

/// Light of one source received by a lumel so far [lx]. A view decides occlusion only for lumels
/// hit by one of its rays, which has a probability P. Therefore three sums are kept; H = U N / D is
/// exact wherever nothing or everything is occluded.
struct LightSums {
    vec3 open;     ///< U: unoccluded
    vec3 known;    ///< D: unoccluded, if V is known, over P: U on average
    vec3 arrived;  ///< N: part of D that arrives
};

LUMEL_SHARED_END
#endif
