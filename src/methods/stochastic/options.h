#pragma once
// Options of stochastic shooting.

#include <cstdint>

#include "atlas/lumels/sample_rule.h"
#include "raster/eyes/view_options.h"
#include "solve/shooting/iteration_options.h"

namespace lumel {

struct StochasticOptions {
    std::uint32_t seed = 1;
    ViewOptions views{.projection = Projection::hemicube, .hemicube = 256, .batch = 16};
    SampleRule rule = SampleRule::area;
    IterationOptions iteration;
    bool disc = false;  ///< with Scheme::paper: shooters are discs, [BSS05] Eq. (8)
    /// With Scheme::paper: squares of 2^merge texels a side shoot as one, as far as they belong to
    /// one chart, [BSS05] section 5. 0: each texel alone.
    std::uint32_t merge = 0;
};

}  // namespace lumel
