#pragma once
// The options of stochastic shooting as a table.

#include "methods/stochastic/options.h"
#include "solve/shooting/common_options.h"
#include "solve/shooting/shooters.shared.h"

namespace lumel {

inline constexpr OptionInfo kStochasticOptions[] = {
    seed_option(member<&StochasticOptions::seed>),
    scheme_option(member<&StochasticOptions::iteration, &IterationOptions::scheme>),
    sampling_option(member<&StochasticOptions::rule>),
    batch_option(member<&StochasticOptions::views, &ViewOptions::batch>, kMaxBatch),
    projection_option(member<&StochasticOptions::views, &ViewOptions::projection>),
    hemicube_option(member<&StochasticOptions::views, &ViewOptions::hemicube>),
};

}  // namespace lumel
