#ifndef LUMEL_RASTER_EYES_EYE_VIEWS_SHARED_H
#define LUMEL_RASTER_EYES_EYE_VIEWS_SHARED_H
#include "raster/world/passage.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kHemicube = 0u;
LUMEL_CONST uint kHemisphere = 1u;

LUMEL_CONST uint kHemicubeFaces = 5u;  ///< front, then the half faces +t, -t, +b, -b

/// From where is looked: a point and an orthonormal frame, in the world.
struct Eye {
    vec3 position;   ///< [m]
    vec3 tangent;    ///< t
    vec3 bitangent;  ///< b
    vec3 normal;     ///< n, the axis of the hemisphere
    uint random;     ///< seeds the chance by which surfaces with alpha block
    uint channel;    ///< that is looked in, see passage.shared.h
};

/// How views lie in the depth image, one tile an eye.
/// A hemicube is a tile of 2 side × 3/2 side pixels: the front face in its top left corner, +t and
/// -t right of it one above the other, +b and -b below. Stored: near / distance along the axis.
/// A hemisphere is a tile of side × side pixels, filled by a disc: a direction (t, b, n) of length
/// 1 is found at ((t, b) + 1) side / 2. Stored: near / distance.
struct EyeViewLayout {
    uint side;     ///< of the front face, or of the disc [pixels]
    uint columns;  ///< tiles in a row of the image
    float near;    ///< nearer surfaces are not seen [m]
};

/// Push constants of the shaders that draw views.
struct LookParams {
    uint eye;          ///< index into the eyes
    uint face;         ///< of a hemicube, 0…4
    float near;        ///< [m]
    Passage passage;   ///< of cut-outs
    uint first_index;  ///< of the indices drawn
    // Of a hemisphere:
    uvec2 corner;      ///< of the tile [pixels]
    float radius;      ///< of the disc [pixels]
    uint first_block;  ///< of the range's triangles, see hemisphere.shared.h
    uint blocks;       ///< of the range
};

LUMEL_SHARED_END
#endif
