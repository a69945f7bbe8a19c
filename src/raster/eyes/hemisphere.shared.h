#ifndef LUMEL_RASTER_EYES_HEMISPHERE_SHARED_H
#define LUMEL_RASTER_EYES_HEMISPHERE_SHARED_H
#include "base/core/dispatch.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kCutBlock = 256u;  ///< triangles per thread of hemisphere.count.comp

/// Numbers of strip pieces and of patches in the triangles before.
struct CutCount {
    uint pieces;   ///< pieces of strips and whole triangles
    uint patches;  ///< triangles to tessellate
};

/// Arguments of an indirect draw, as defined by Vulkan.
struct DrawnVertices {
    uint vertices;
    uint instances;
    uint first_vertex;
    uint first_instance;
};

/// Push constants of hemisphere.cut.comp, hemisphere.count.comp and hemisphere.place.comp, which
/// subdivide the triangles of one range for some eyes. There is one slot per triangle, rounded up
/// to whole blocks.
struct CutParams {
    uint first_eye;
    uint eyes;
    uint first_index;  ///< first index to draw
    uint triangles;
    uint first_block;  ///< first block of the range, for the first eye
    uint blocks;       ///< number of blocks of the range
    uint eye_blocks;   ///< stride per eye
    uint first_draw;   ///< first draw of the first eye; two per range: strips, patches
    uint eye_draws;    ///< stride per eye
    float near;        ///< [m]
    float radius;      ///< disc radius [pixels]
    float chord;       ///< longest arc that a straight line may replace [rad]
};

LUMEL_SHARED_END
#endif
