#ifndef LUMEL_RASTER_EYES_EYE_VIEWS_SHARED_H
#define LUMEL_RASTER_EYES_EYE_VIEWS_SHARED_H
#include "base/core/dispatch.shared.h"
#include "raster/world/passage.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kHemicube = 0u;
LUMEL_CONST uint kHemisphere = 1u;

LUMEL_CONST uint kHemicubeFaces = 5u;  ///< front, then the half faces +t, -t, +b, -b

/// Viewpoint: position and orthonormal frame, world space.
struct Eye {
    vec3 position;   ///< [m]
    vec3 tangent;    ///< t
    vec3 bitangent;  ///< b
    vec3 normal;     ///< n, the axis of the hemisphere
    uint random;     ///< seed for the random opacity of surfaces with alpha
    uint channel;    ///< channel of the view, see passage.shared.h
};

/// Layout of views in the depth image, one tile per eye. A hemicube is a tile of 2 side × 3/2 side
/// pixels: the front face at the top left, +t and -t to its right, one above the other, +b and -b
/// below. Stored: near / distance along the axis. A hemisphere is a tile of side × side pixels with
/// a disc: the unit direction (t, b, n) is at ((t, b) + 1) side / 2. Stored: near / distance.
struct EyeViewLayout {
    uint side;     ///< side of the front face, or diameter of the disc [pixels]
    uint columns;  ///< tiles per row of the image
    float near;    ///< minimum distance of visible surfaces [m]
};

/// Push constants of the shaders that render views.
struct LookParams {
    uint eye;          ///< index into the eyes
    uint face;         ///< hemicube face, 0…4
    float near;        ///< [m]
    Passage passage;   ///< for cut-outs
    uint first_index;  ///< first index to draw
    // Hemisphere only:
    uvec2 corner;      ///< tile corner [pixels]
    float radius;      ///< disc radius [pixels]
    uint first_block;  ///< first block of the range's triangles, see hemisphere.shared.h
    uint blocks;       ///< number of blocks of the range
};

LUMEL_SHARED_END
#endif
