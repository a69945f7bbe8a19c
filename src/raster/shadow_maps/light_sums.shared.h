#ifndef LUMEL_RASTER_SHADOW_MAPS_LIGHT_SUMS_SHARED_H
#define LUMEL_RASTER_SHADOW_MAPS_LIGHT_SUMS_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kLightSumsGroup = 64u;  ///< threads per workgroup of light_sums.finish.comp

/// Light of one source that a lumel has received so far [lx]. A view shows whether light is hidden
/// only for lumels that one of its rays meets, which has a probability P. So three sums are kept,
/// and H = U N / D is exact wherever nothing or everything is hidden.
struct LightSums {
    vec3 open;     ///< U: unoccluded
    vec3 known;    ///< D: the same where V is known, over P: U in the mean
    vec3 arrived;  ///< N: of D, what arrives
};

/// Push constants of light_sums.finish.comp.
struct FinishLightParams {
    uint count;  ///< N lumels
};

LUMEL_SHARED_END
#endif
