#ifndef LUMEL_TRANSPORT_PATCHES_GLSL
#define LUMEL_TRANSPORT_PATCHES_GLSL

// Patches of a chart by level.

#include "solve/transport/patches.shared.h"

uint points_per_lumel(uint level)
{
    return level <= kLumelLevel ? 1u : 1u << (2u * (level - kLumelLevel));
}

uint patches_of(PatchChart chart, uint level)
{
    if (level < kBlockLevels)
        return chart.patch_count[level];
    return chart.lumel_count * points_per_lumel(level);
}

#endif
