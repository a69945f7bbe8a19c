#ifndef LUMEL_SOLVE_SHOOTING_POWER_PYRAMID_SHARED_H
#define LUMEL_SOLVE_SHOOTING_POWER_PYRAMID_SHARED_H
#include "base/core/dispatch.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kPyramidFanout = 32u;  ///< children summed into one parent
LUMEL_CONST uint kPyramidLevels = 7u;   ///< for 32⁶ leaves, more than 32 bits can count

/// First element of each level in the pyramid's array. Level 0 has the leaves, one per lumel; the
/// last level used has the root.
struct PyramidLayout {
    uint first[kPyramidLevels];
    uint count[kPyramidLevels];
    uint levels;
};

/// Push constants of power_pyramid.leaves.comp.
struct PyramidLeafParams {
    uint count;      ///< N
    float by_area;   ///< fraction distributed by area alone, 0…1
    float area_sum;  ///< Σ A of reflecting lumels [m²]
};

/// Push constants of power_pyramid.sum.comp.
struct PyramidSumParams {
    uint from;  ///< first element of the children's level
    uint from_count;
    uint to;  ///< first element of the parents' level
    uint to_count;
};

LUMEL_SHARED_END
#endif
