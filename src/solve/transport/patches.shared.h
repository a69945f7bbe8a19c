#ifndef LUMEL_SOLVE_TRANSPORT_PATCHES_SHARED_H
#define LUMEL_SOLVE_TRANSPORT_PATCHES_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

/// How finely a chart's light is shot, from blocks of 4 × 4 texels to 16 points of each lumel.
LUMEL_CONST uint kBlockLevels = 2u;  ///< levels 0 and 1: listed blocks of 4 × 4 and 2 × 2 texels
LUMEL_CONST uint kLumelLevel = 2u;   ///< each lumel from one point; from here on nothing is listed
LUMEL_CONST uint kPatchLevels = 5u;  ///< levels 3 and 4: 4 and 16 points of each lumel

LUMEL_CONST uint kFromMean = 0xffffffffu;  ///< Patch::eye: at the mean of its lumels

/// A shooter of progressive radiosity: lumels of one chart that lie in one block of texels.
struct Patch {
    uint first;  ///< its lumels are [first, first + count)
    uint count;
    uint eye;    ///< lumel that it shoots from, or kFromMean
    float size;  ///< diameter of a ball that holds its lumels [m]
};

/// The lumels of one side of a chart, and their patches.
struct PatchChart {
    uint first_lumel;
    uint lumel_count;
    uint first_patch[kBlockLevels];
    uint patch_count[kBlockLevels];
    uint moving;  ///< 1: its lumels are kLumelMoving, and cross redistribution alone shoots from
                  ///< them
};

LUMEL_SHARED_END
#endif
