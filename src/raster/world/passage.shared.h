#ifndef LUMEL_RASTER_WORLD_PASSAGE_SHARED_H
#define LUMEL_RASTER_WORLD_PASSAGE_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

/// Light transmission of a surface with alpha or of glass.
struct Passage {
    float cutoff;        ///< covered if alpha ≥ cutoff; < 0: coverage is alpha
    float transmission;  ///< share of glass in the covered area
    vec3 color;          ///< glass colour, linear; multiplies the texture
};

/// A pixel of a view has one depth, but coloured glass blocks the channels differently, so views
/// may be restricted to one channel: 1 + c for channel c. In kAllChannels glass blocks the average.
LUMEL_CONST uint kAllChannels = 0u;
LUMEL_CONST uint kChannels = 3u;

LUMEL_SHARED_END
#endif
