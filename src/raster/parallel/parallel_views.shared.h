#ifndef LUMEL_RASTER_PARALLEL_PARALLEL_VIEWS_SHARED_H
#define LUMEL_RASTER_PARALLEL_PARALLEL_VIEWS_SHARED_H
#include "raster/world/passage.shared.h"
LUMEL_SHARED_BEGIN

/// A parallel projection of the world onto a square tile of pixels. A point x falls on
/// (right, up)·x + shift [pixels from the tile's corner]; what is nearer to the light has the
/// larger toward·x + depth_shift, which lies in 0…1.
struct ParallelView {
    vec3 right;         ///< [pixels / m]
    vec3 up;            ///< [pixels / m]
    vec3 toward;        ///< against the rays [1 / m]
    vec2 shift;         ///< [pixels]
    float depth_shift;  ///< [1]
    uint random;        ///< seeds the chance by which surfaces with alpha block
    uint channel;       ///< that is looked in, see passage.shared.h
};

/// How the tiles lie in the image.
struct ParallelLayout {
    uint side;     ///< of a tile [pixels]
    uint columns;  ///< tiles in a row of the image
};

/// Push constants of the shaders that draw parallel views.
struct ParallelLookParams {
    ParallelLayout tiling;
    uint view;
    Passage passage;  ///< of cut-outs
};

LUMEL_SHARED_END
#endif
