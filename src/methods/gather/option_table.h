#pragma once
// The options of gathering by hemicubes as a table.

#include "methods/gather/gather.shared.h"
#include "methods/gather/options.h"
#include "solve/shooting/common_options.h"

namespace lumel {

inline constexpr OptionWord kIntegrations[] = {{"sum", Integration::sum},
                                               {"mipmap", Integration::mipmap}};

inline constexpr OptionInfo kGatherOptions[] = {
    seed_option(member<&GatherOptions::seed>),
    sampling_option(member<&GatherOptions::rule>),
    batch_option(member<&GatherOptions::batch>, kMaxHemicubes),
    hemicube_option(member<&GatherOptions::hemicube>),
    {.name = "integration",
     .help = "Sum each hemicube in one pass (sum), or by a mipmap chain as in the thesis (mipmap); "
             "the light is the same",
     .words = kIntegrations,
     .member = member<&GatherOptions::integration>},
};

}  // namespace lumel
