#ifndef LUMEL_VISIBILITY_HEMICUBE_SHARED_H
#define LUMEL_VISIBILITY_HEMICUBE_SHARED_H
#include "core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kHemicubeFaces = 5u;  ///< front, then the half faces +t, -t, +b, -b

/// Where a hemicube looks from: a point and an orthonormal frame, in the world.
struct Eye {
    vec3 position;   ///< [m]
    vec3 tangent;    ///< t
    vec3 bitangent;  ///< b
    vec3 normal;     ///< n, the axis of the front face
    uint random;     ///< seeds the chance by which blended surfaces block
};

/// How hemicubes lie in the depth image. One hemicube is a tile of 2 side × 3/2 side pixels:
/// the front face in its top left corner, +t and -t right of it one above the other, +b and
/// -b below.
struct HemicubeLayout {
    uint side;     ///< of the front face [pixels]
    uint columns;  ///< tiles in a row of the image
    float near;    ///< distance of the near plane [m]; stored depth = near / distance along axis
};

/// Push constants of hemicube.vert and hemicube.cut_out.frag.
struct HemicubeParams {
    uint eye;      ///< index into the eyes
    uint face;     ///< 0…4
    float near;    ///< [m]
    float cutoff;  ///< cut-outs: opaque where alpha ≥ cutoff; < 0: by chance
};

LUMEL_SHARED_END
#endif
