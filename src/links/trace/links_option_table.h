#pragma once
// The options of the default method as a table.

#include "links/trace/links_options.h"
#include "solve/shooting/common_options.h"

namespace lumel {

inline constexpr OptionWord kLinksSwitch[] = {{"on", true}, {"off", false}};
inline constexpr OptionWord kRayCasters[] = {{"auto", Rays::automatic},
                                             {"host", Rays::host},
                                             {"query", Rays::query},
                                             {"tree", Rays::tree},
                                             {"raster", Rays::raster}};

inline constexpr OptionInfo kLinksOptions[] = {
    seed_option(member<&LinksOptions::seed>),
    sampling_option(member<&LinksOptions::rule>),
    {.name = "filter",
     .help = "Smooth light over charts where it is noise; without it the result is noisier, but "
             "exact in expectation",
     .words = kLinksSwitch,
     .member = member<&LinksOptions::filter>},
    {.name = "guide",
     .help = "Send more rays to where those of the first round found most of the light, as through "
             "a door or window",
     .words = kLinksSwitch,
     .member = member<&LinksOptions::guide>},
    {.name = "rays",
     .help = "Ray tracing by the CPU (host), by ray queries of the GPU (query, VK_KHR_ray_query), "
             "by compute shaders of the GPU that walk a BVH (tree), or by rasterisation on the GPU "
             "for rays that leave lumels (raster); auto: query if a GPU supports it, else host",
     .words = kRayCasters,
     .member = member<&LinksOptions::rays>},
};

}  // namespace lumel
