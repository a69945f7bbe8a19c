#ifndef LUMEL_RASTER_PARALLEL_ILLUMINATION_MAPS_SHARED_H
#define LUMEL_RASTER_PARALLEL_ILLUMINATION_MAPS_SHARED_H
#include "raster/parallel/parallel_views.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kStochasticLayers = 0u;  ///< one surface a pixel, by chance [TN11]
LUMEL_CONST uint kListedLayers = 1u;      ///< all of them, in a linked list
LUMEL_CONST uint kPeeledLayers = 2u;      ///< all of them, one after another

LUMEL_CONST uint kEndOfList = 0xffffffffu;

LUMEL_CONST uint kAbsorbing = 0xffffffffu;  ///< surface of glass that light ends in

/// A surface at a pixel of an illumination map.
struct Fragment {
    uint surface;    ///< 1 + 2 × texel of the atlas + (1: its back); 0: nothing; kAbsorbing
    float nearness;  ///< along the direction, as ParallelView has it
    uint next;       ///< index of the next of this pixel, or kEndOfList
};

/// Fragments of the lists.
struct FragmentCount {
    uint count;     ///< requested by the batch
    uint most;      ///< the same of the largest batch that did not fit
    uint capacity;  ///< there is room for
};

/// Push constants of the shaders that draw illumination maps.
struct IlluminationParams {
    ParallelLayout tiling;
    uint view;   ///< index into the views
    uint tile;   ///< that it is drawn into
    uint width;  ///< of the atlas [texels]
    uint height;
    uint layer;         ///< peeled: how many surfaces of a pixel are taken off
    float depth_scale;  ///< a surface's depth is depth_scale · nearness + depth_shift;
    float depth_shift;  ///< what is not in 0…1 is not drawn
    uint ordinary;      ///< stochastic: 1: the surface of the largest depth stays, not a random one
    Passage passage;    ///< of cut-outs
};

LUMEL_SHARED_END
#endif
