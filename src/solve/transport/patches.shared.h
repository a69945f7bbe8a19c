#ifndef LUMEL_SOLVE_TRANSPORT_PATCHES_SHARED_H
#define LUMEL_SOLVE_TRANSPORT_PATCHES_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

/// Resolution of a chart's shooters, from blocks of 4 × 4 texels to 16 points per lumel.
LUMEL_CONST uint kBlockLevels = 2u;  ///< levels 0 and 1: listed blocks of 4 × 4 and 2 × 2 texels
LUMEL_CONST uint kLumelLevel = 2u;   ///< one point per lumel; nothing is listed from here on
LUMEL_CONST uint kPatchLevels = 5u;  ///< levels 3 and 4: 4 and 16 points per lumel

LUMEL_CONST uint kFromMean = 0xffffffffu;  ///< Patch::eye: at the mean of its lumels

/// A shooter of progressive radiosity: lumels of one chart that lie in one block of texels.
struct Patch {
    uint first;  ///< its lumels are [first, first + count)
    uint count;
    uint eye;    ///< viewpoint: a lumel, or kFromMean
    float size;  ///< diameter of its bounding sphere [m]
};

/// The lumels of one side of a chart, and their patches.
struct PatchChart {
    uint first_lumel;
    uint lumel_count;
    uint first_patch[kBlockLevels];
    uint patch_count[kBlockLevels];
    uint moving;  ///< 1: kLumelMoving; only cross redistribution shoots from these lumels
                  ///< them
};

LUMEL_SHARED_END
#endif
