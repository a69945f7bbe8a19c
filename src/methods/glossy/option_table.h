#pragma once
// The options of glossy shooting as a table.

#include "methods/glossy/lobes.shared.h"
#include "methods/glossy/options.h"
#include "solve/shooting/common_options.h"

namespace lumel {

inline constexpr OptionInfo kGlossyOptions[] = {
    seed_option(member<&GlossyOptions::seed>),
    scheme_option(member<&GlossyOptions::scheme>),
    sampling_option(member<&GlossyOptions::rule>),
    batch_option(member<&GlossyOptions::views, &ViewOptions::batch>, kMaxGlossyBatch),
    projection_option(member<&GlossyOptions::views, &ViewOptions::projection>),
    hemicube_option(member<&GlossyOptions::views, &ViewOptions::hemicube>),
};

}  // namespace lumel
