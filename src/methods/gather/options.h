#pragma once
// Options of gathering by hemicubes.

#include <cstdint>

#include "atlas/lumels/sample_rule.h"

namespace lumel {

struct GatherOptions {
    std::uint32_t seed = 1;
    int batch = 16;  ///< K, hemicubes at a time
    /// Side of the front face [pixels], see EyeViews. Pixels have four samples, and points move
    /// from bounce to bounce, so few pixels are enough.
    int hemicube = 32;
    SampleRule rule = SampleRule::area;
};

}  // namespace lumel
