#pragma once
// Options of gathering by hemicubes.

#include <cstdint>

#include "atlas/lumels/sample_rule.h"

namespace lumel {

/// Sum over the pixels of a hemicube [Hoef13] 4.2. Both give the same light, except for rounding.
enum class Integration {
    sum,     ///< parallel reduction in a workgroup: reads each pixel once
    mipmap,  ///< average of a mipmap chain, each level written to memory
};

struct GatherOptions {
    std::uint32_t seed = 1;
    int batch = 16;  ///< K, hemicubes at a time
    /// Side of the front face [pixels], see EyeViews. Pixels have four samples, and points move
    /// from bounce to bounce, so few pixels are enough.
    int hemicube = 32;
    SampleRule rule = SampleRule::area;
    Integration integration = Integration::sum;
};

}  // namespace lumel
