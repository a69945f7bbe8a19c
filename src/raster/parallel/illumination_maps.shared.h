#ifndef LUMEL_RASTER_PARALLEL_ILLUMINATION_MAPS_SHARED_H
#define LUMEL_RASTER_PARALLEL_ILLUMINATION_MAPS_SHARED_H
#include "raster/parallel/parallel_views.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kStochasticLayers = 0u;  ///< one random surface per pixel [TN11]
LUMEL_CONST uint kListedLayers = 1u;      ///< all surfaces, in a linked list
LUMEL_CONST uint kPeeledLayers = 2u;      ///< all surfaces, peeled in several passes

LUMEL_CONST uint kEndOfList = 0xffffffffu;

LUMEL_CONST uint kAbsorbing = 0xffffffffu;  ///< surface of absorbing glass

/// A surface at a pixel of an illumination map.
struct Fragment {
    uint surface;    ///< 1 + 2 × texel of the atlas + (back: 1); 0: none; kAbsorbing
    float nearness;  ///< along the direction, see ParallelView
    uint next;       ///< next Fragment of this pixel, or kEndOfList
};

/// Usage of the lists.
struct FragmentCount {
    uint count;     ///< fragments of the batch
    uint most;      ///< fragments of the largest batch that overflowed
    uint capacity;  ///< maximum number of fragments
};

/// Push constants of the shaders that render illumination maps.
struct IlluminationParams {
    ParallelLayout tiling;
    uint view;   ///< index into the views
    uint tile;   ///< tile to render to
    uint width;  ///< atlas size [texels]
    uint height;
    uint layer;         ///< peeled: number of surfaces already removed per pixel
    float depth_scale;  ///< a surface's depth is depth_scale · nearness + depth_shift;
    float depth_shift;  ///< depths outside 0…1 are clipped
    uint ordinary;      ///< stochastic: 1: ordinary depths instead of random ones
    Passage passage;    ///< for cut-outs
};

LUMEL_SHARED_END
#endif
