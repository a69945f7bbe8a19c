#pragma once
// Options of gathering by hemicubes.

#include <cstdint>

#include "atlas/lumels/sample_rule.h"

namespace lumel {

struct GatherOptions {
    std::uint32_t seed = 1;
    int batch = 16;      ///< K, hemicubes at a time
    int hemicube = 256;  ///< side of the front face [pixels], see EyeViews
    SampleRule rule = SampleRule::area;
};

}  // namespace lumel
