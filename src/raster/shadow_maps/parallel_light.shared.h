#ifndef LUMEL_RASTER_SHADOW_MAPS_PARALLEL_LIGHT_SHARED_H
#define LUMEL_RASTER_SHADOW_MAPS_PARALLEL_LIGHT_SHARED_H
#include "raster/parallel/parallel_views.shared.h"
#include "raster/shadow_maps/light_sums.shared.h"
LUMEL_SHARED_BEGIN

/// Light from infinity along one direction.
struct ParallelSource {
    vec3 toward;       ///< unit, from the scene to the light
    vec3 illuminance;  ///< [lx] on a surface facing it
};

/// Push constants of parallel_light.receive.comp.
struct ParallelReceiveParams {
    ParallelLayout tiling;
    DispatchRange range;  ///< lumels of this dispatch
    uint first_view;      ///< views [first_view, first_view + views) in tiles 0, 1, …
    uint views;
    uint views_per_source;  ///< consecutive views of a source
    uint seed;
    uint centre;  ///< 1: receive at the centroid
};

LUMEL_SHARED_END
#endif
