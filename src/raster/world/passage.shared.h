#ifndef LUMEL_RASTER_WORLD_PASSAGE_SHARED_H
#define LUMEL_RASTER_WORLD_PASSAGE_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

/// How light passes a surface with alpha or of glass.
struct Passage {
    float cutoff;        ///< the surface is there where alpha ≥ cutoff; < 0: its share is alpha
    float transmission;  ///< of what is there, the share that is glass
    vec3 color;          ///< of glass, linear; multiplies the texture
};

/// A pixel of a view holds one depth, and coloured glass blocks more of one colour than of another:
/// so there are views that carry one colour channel each. Channel c is 1 + c; or all of them, and
/// glass blocks as it does in the mean.
LUMEL_CONST uint kAllChannels = 0u;
LUMEL_CONST uint kChannels = 3u;

LUMEL_SHARED_END
#endif
