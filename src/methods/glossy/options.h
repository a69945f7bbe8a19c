#pragma once
// Options of glossy shooting.

#include <cstdint>

#include "atlas/lumels/sample_rule.h"
#include "raster/eyes/view_options.h"
#include "solve/shooting/iteration_options.h"

namespace lumel {

struct GlossyOptions {
    std::uint32_t seed = 1;
    ViewOptions views{.projection = Projection::hemicube, .hemicube = 256, .batch = 16};
    SampleRule rule = SampleRule::area;  ///< for receivers
    Scheme scheme = Scheme::phased;
    /// With Scheme::paper: squares of 2^merge texels a side shoot as one from their common centre,
    /// as far as they belong to one chart, [BSS05] section 5. 0: each texel alone.
    std::uint32_t merge = 1;
    /// With Scheme::paper: a tenth of the shooters is drawn by area alone, and all are weighted
    /// [VG95]; else all are drawn by power.
    bool two_choices = true;
};

}  // namespace lumel
