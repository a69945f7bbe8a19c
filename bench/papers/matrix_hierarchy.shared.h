#ifndef LUMEL_BENCH_MATRIX_HIERARCHY_SHARED_H
#define LUMEL_BENCH_MATRIX_HIERARCHY_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kHierarchyGroup = 64u;

/// A run of values, two half floats to a word, and what they are multiplied by.
struct HierarchySegment {
    uint word;    ///< of the first two values
    uint source;  ///< place of the first factor
    uint words;
    uint seen;  ///< 1: factors are those that V^T sees, 0: light of patches
};

/// Push constants of matrix_hierarchy.dot.comp.
struct HierarchyParams {
    uint rows;
    uint plane;  ///< rows of a channel
    vec3 scale;  ///< of each channel
};

LUMEL_SHARED_END
#endif
