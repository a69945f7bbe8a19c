#pragma once
// Options that several methods read. Each method gives the member and the limits.

#include <cstdint>
#include <limits>

#include "atlas/lumels/sample_rule.h"
#include "raster/eyes/view_options.h"
#include "solve/shooting/iteration_options.h"
#include "solve/solver/option_info.h"

namespace lumel {

inline constexpr std::int64_t kMinHemicube = 16,
                              kMaxHemicube = 2048;  // side of a hemicube [pixels]

inline constexpr OptionWord kSampleRules[] = {{"area", SampleRule::area},
                                              {"centre", SampleRule::centre}};
inline constexpr OptionWord kProjections[] = {{"hemicube", Projection::hemicube},
                                              {"hemisphere", Projection::hemisphere}};
inline constexpr OptionWord kSchemes[] = {{"phased", Scheme::phased}, {"paper", Scheme::paper}};

constexpr OptionInfo seed_option(const MemberAccess& seed)
{
    return {.name = "seed",
            .help = "Random seed",
            .highest = std::numeric_limits<std::uint32_t>::max(),
            .member = seed};
}

constexpr OptionInfo scheme_option(const MemberAccess& scheme)
{
    return {.name = "scheme",
            .help = "Iteration scheme: phases with exact near pairs (phased), or that of the "
                    "papers (paper)",
            .words = kSchemes,
            .member = scheme};
}

constexpr OptionInfo sampling_option(const MemberAccess& rule)
{
    return {.name = "sampling",
            .help = "Receive over the covered area of a lumel (area) or at its centre",
            .words = kSampleRules,
            .member = rule};
}

constexpr OptionInfo batch_option(const MemberAccess& batch, std::int64_t highest)
{
    return {.name = "batch",
            .help = "Shooters (or hemicubes, or directions) per iteration",
            .unit = "K",
            .lowest = 1,
            .highest = highest,
            .member = batch};
}

constexpr OptionInfo projection_option(const MemberAccess& projection)
{
    return {
        .name = "projection",
        .help =
            "Rasterise the view of a shooter on five faces (hemicube) or on one disc (hemisphere)",
        .words = kProjections,
        .member = projection};
}

constexpr OptionInfo hemicube_option(const MemberAccess& side)
{
    return {
        .name = "hemicube",
        .help =
            "Front face of a hemicube, side in pixels; the disc of a hemisphere is twice as wide",
        .lowest = kMinHemicube,
        .highest = kMaxHemicube,
        .member = side};
}

}  // namespace lumel
