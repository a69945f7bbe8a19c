#ifndef LUMEL_RASTER_EYES_HEMISPHERE_SHARED_H
#define LUMEL_RASTER_EYES_HEMISPHERE_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kCutGroup = 64u;   ///< threads per workgroup of hemisphere.*.comp
LUMEL_CONST uint kCutBlock = 256u;  ///< triangles that one thread of hemisphere.count.comp counts

/// Of the triangles before: how many pieces of strips they are, and how many patches.
struct CutCount {
    uint pieces;   ///< of triangles that are cut into strips, or whole
    uint patches;  ///< triangles that the tessellator cuts
};

/// Arguments of an indirect draw, as Vulkan has them.
struct DrawnVertices {
    uint vertices;
    uint instances;
    uint first_vertex;
    uint first_instance;
};

/// Push constants of hemisphere.cut.comp, hemisphere.count.comp and hemisphere.place.comp, which
/// cut the triangles of one range for some eyes. Slots, one for each triangle, come in whole
/// blocks.
struct CutParams {
    uint first_eye;
    uint eyes;
    uint first_index;  ///< of the indices drawn
    uint triangles;
    uint first_block;  ///< of the range's slots, of the first eye
    uint blocks;       ///< of the range
    uint eye_blocks;   ///< from one eye to the next
    uint first_draw;   ///< of the first eye; two for each range: strips, patches
    uint eye_draws;    ///< from one eye to the next
    float near;        ///< [m]
    float radius;      ///< of the disc [pixels]
    float chord;       ///< the longest arc that one straight line stands for [rad]
};

LUMEL_SHARED_END
#endif
