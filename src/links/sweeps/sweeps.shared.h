#ifndef LUMEL_LINKS_SWEEPS_SWEEPS_SHARED_H
#define LUMEL_LINKS_SWEEPS_SWEEPS_SHARED_H
#include "base/core/dispatch.shared.h"
#include "links/kept/near_weight.shared.h"

// A sweep over links as the CPU and the GPU compute it, with the same results bit for bit: light
// along the links of a sub-lumel is added in the order of the links, sums over sub-lumels have
// kGroup terms each, in order. The CPU adds these sums in double precision.

LUMEL_SHARED_BEGIN

/// Sub-lumels of a slice: their links lie column by column, so that invocations side by side read
/// words side by side.
LUMEL_CONST uint kSliceRows = 32u;

/// Further words of a slice's links, stored after their ends in the same order.
LUMEL_CONST uint kWeights = 1u;  ///< floats
LUMEL_CONST uint kColors = 2u;   ///< weights of near links, RGB9E5

/// Links of sub-lumels that have about as many, as words of an array: kSliceRows numbers of
/// sub-lumels, then columns. Row r has its k-th end in the k-th column's r-th word. Shorter rows
/// end with links to a dark sub-lumel.
struct LinkSlice {
    uint rows;     ///< at most kSliceRows
    uint first;    ///< word
    uint columns;  ///< links of the longest row
    uint kinds;    ///< kWeights, kColors, both or neither
};

/// Sums over kGroup consecutive sub-lumels, of radiosity summed over channels.
struct SweepSums {
    float squares;  ///< squared relative changes
    float light;    ///< [lm/m²]
    uint lit;       ///< sub-lumels with any
};

/// Members [first, last) of a group, at most kGroup.
struct GroupSpan {
    uint first;
    uint last;
};

/// Sums over a GroupSpan, weighted by area.
struct GroupSums {
    vec3 change;
    vec3 light;
};

/// Push constants of sweeps.gather.comp.
struct SweepGatherParams {
    DispatchRange range;
    uint slices;
};

/// Push constants of sweeps.receive.comp.
struct SweepReceiveParams {
    DispatchRange range;
    uint parts;
    float darkest;  ///< see sweep_sums()
};

/// Push constants of sweeps.groups.comp.
struct SweepGroupsParams {
    DispatchRange range;
};

/// Push constants of sweeps.correct.comp.
struct SweepCorrectParams {
    DispatchRange range;
    uint parts;
};

// GLSL has no references. NOLINTBEGIN(performance-unnecessary-value-param)

/// Irradiance from the sum of light along rays. share: 1 / rays.
LUMEL_FUNCTION vec3 mean_light(vec3 sum, float share)
{
    LUMEL_PRECISE vec3 mean = sum * share;
    return without_tiny(mean);
}

LUMEL_FUNCTION vec3 radiosity(vec3 albedo, vec3 irradiance)
{
    LUMEL_PRECISE vec3 reflected = albedo * irradiance;
    return without_tiny(reflected);
}

/// Sums of one sub-lumel. Changes are relative to its light plus `darkest` [lm/m²].
LUMEL_FUNCTION SweepSums sweep_sums(vec3 before, vec3 after, float darkest)
{
    LUMEL_PRECISE float then = before.x + before.y;
    then = then + before.z;
    LUMEL_PRECISE float now = after.x + after.y;
    now = now + after.z;
    SweepSums sums;
    sums.squares = 0.0f;
    sums.light = now;
    sums.lit = 0u;
    if (now > 0.0f) {
        LUMEL_PRECISE float change = now - then;
        LUMEL_PRECISE float scale = now + darkest;
        LUMEL_PRECISE float relative = change * reciprocal(scale);
        LUMEL_PRECISE float square = relative * relative;
        sums.squares = without_tiny(square);
        sums.lit = 1u;
    }
    return sums;
}

LUMEL_FUNCTION SweepSums plus(SweepSums a, SweepSums b)
{
    LUMEL_PRECISE float squares = a.squares + b.squares;
    LUMEL_PRECISE float light = a.light + b.light;
    a.squares = squares;
    a.light = light;
    a.lit += b.lit;
    return a;
}

/// Sums of one sub-lumel.
LUMEL_FUNCTION GroupSums group_sums(vec3 before, vec3 after, float area)
{
    LUMEL_PRECISE vec3 difference = after - before;
    LUMEL_PRECISE vec3 change = area * difference;
    LUMEL_PRECISE vec3 light = area * after;
    GroupSums sums;
    sums.change = without_tiny(change);
    sums.light = without_tiny(light);
    return sums;
}

LUMEL_FUNCTION GroupSums plus(GroupSums a, GroupSums b)
{
    LUMEL_PRECISE vec3 change = a.change + b.change;
    LUMEL_PRECISE vec3 light = a.light + b.light;
    a.change = change;
    a.light = light;
    return a;
}

// NOLINTEND(performance-unnecessary-value-param)

LUMEL_SHARED_END
#endif
