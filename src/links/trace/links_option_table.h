#pragma once
// The options of the default method as a table.

#include "links/trace/links_options.h"
#include "solve/shooting/common_options.h"

namespace lumel {

inline constexpr OptionWord kFilterSwitch[] = {{"on", true}, {"off", false}};
inline constexpr OptionWord kRayCasters[] = {{"auto", Rays::automatic},
                                             {"host", Rays::host},
                                             {"query", Rays::query},
                                             {"raster", Rays::raster}};

inline constexpr OptionInfo kLinksOptions[] = {
    seed_option(member<&LinksOptions::seed>),
    sampling_option(member<&LinksOptions::rule>),
    {.name = "filter",
     .help =
         "Average lumels with those around them that look alike; without it the result is exact "
         "in expectation",
     .words = kFilterSwitch,
     .member = member<&LinksOptions::filter>},
    {.name = "rays",
     .help =
         "What casts the rays: the host, ray queries of the device (VK_KHR_ray_query), or "
         "drawings by the device for rays that leave lumels; auto: the host on a device that is "
         "a CPU, else queries where the device has them, else drawings",
     .words = kRayCasters,
     .member = member<&LinksOptions::rays>},
};

}  // namespace lumel
