#pragma once
// The options of progressive refinement as a table.

#include "methods/progressive/options.h"
#include "solve/shooting/common_options.h"
#include "solve/transport/patch_shots.shared.h"

namespace lumel {

inline constexpr OptionInfo kProgressiveOptions[] = {
    seed_option(member<&ProgressiveOptions::seed>),
    batch_option(member<&ProgressiveOptions::views, &ViewOptions::batch>, kMaxPatchBatch),
    projection_option(member<&ProgressiveOptions::views, &ViewOptions::projection>),
    hemicube_option(member<&ProgressiveOptions::views, &ViewOptions::hemicube>),
};

}  // namespace lumel
