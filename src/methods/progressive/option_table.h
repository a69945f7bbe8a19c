#pragma once
// The options of progressive refinement as a table.

#include "methods/progressive/options.h"
#include "solve/shooting/common_options.h"
#include "solve/transport/patch_shots.shared.h"

namespace lumel {

inline constexpr std::int64_t kMaxShooters = 1 << 16;

inline constexpr OptionInfo kProgressiveOptions[] = {
    seed_option(member<&ProgressiveOptions::seed>),
    {.name = "shooters",
     .help = "Patches are subdivided until each sends at most 1/N of all light; fewer are faster, "
             "and shadows show steps",
     .lowest = 1,
     .highest = kMaxShooters,
     .member = member<&ProgressiveOptions::shooters>},
    batch_option(member<&ProgressiveOptions::views, &ViewOptions::batch>, kMaxPatchBatch),
    projection_option(member<&ProgressiveOptions::views, &ViewOptions::projection>),
    hemicube_option(member<&ProgressiveOptions::views, &ViewOptions::hemicube>),
};

}  // namespace lumel
