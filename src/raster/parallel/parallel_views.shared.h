#ifndef LUMEL_RASTER_PARALLEL_PARALLEL_VIEWS_SHARED_H
#define LUMEL_RASTER_PARALLEL_PARALLEL_VIEWS_SHARED_H
#include "base/core/dispatch.shared.h"
#include "raster/world/passage.shared.h"
LUMEL_SHARED_BEGIN

/// A parallel projection of the world to a square tile of pixels. A point x is at (right, up)·x +
/// shift [pixels from the tile's corner]. Its nearness to the light is toward·x + depth_shift, in
/// 0…1.
struct ParallelView {
    vec3 right;         ///< [pixels / m]
    vec3 up;            ///< [pixels / m]
    vec3 toward;        ///< opposite to the light's direction [1 / m]
    vec2 shift;         ///< [pixels]
    float depth_shift;  ///< [1]
    uint random;        ///< seed for the random opacity of surfaces with alpha
    uint channel;       ///< channel of the view, see passage.shared.h
};

/// Layout of tiles in the image.
struct ParallelLayout {
    uint side;     ///< tile side [pixels]
    uint columns;  ///< tiles per row of the image
};

/// Push constants of the shaders that render parallel views.
struct ParallelLookParams {
    ParallelLayout tiling;
    uint view;
    Passage passage;  ///< for cut-outs
};

LUMEL_SHARED_END
#endif
