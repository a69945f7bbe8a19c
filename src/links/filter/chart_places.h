#pragma once
// Where the charts are in the atlas.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

/// A side of a chart in the atlas.
struct ChartPlace {
    glm::ivec2 low, high;  ///< first and last texel
    std::uint32_t chart;
    bool is_back;
};

/// All that have lumels, largest first.
std::vector<ChartPlace> chart_places(const Lumels& lumels);

}  // namespace lumel
