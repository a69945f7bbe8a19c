#pragma once
// Light of rare rays: single lumels that are many times brighter than all around them.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "links/filter/filter_chart.h"
#include "links/filter/fit_level.h"

namespace lumel {

/// A ray of one estimate met a small bright surface that few rays meet. Its light belongs to all
/// lumels around, each of which meets it as rarely.
struct Outlier {
    std::uint32_t texel;     ///< of the chart
    std::uint32_t estimate;  ///< that has it
    std::uint32_t spread;    ///< lumels that share it
    float share;             ///< of the estimate's light at the lumel, that is shared
    glm::vec3 of_sum;        ///< the same, of the sum of all estimates
};

struct Outliers {
    std::vector<Outlier> all;
    /// [texels] Luminance of the mean of all estimates without the outliers' shares, to which their
    /// light is shared in proportion.
    std::vector<float> luminance;
};

/// Lumels whose light in one estimate is a multiple of the mean of all other estimates at the next
/// lumels, at many around, and of all estimates at any of the next.
template <std::size_t Count>
Outliers find_outliers(const FilterChart& chart, const std::vector<FitLight<Count>>& light);

/// Shares the light of outliers among the nearest lumels that open steps lead to.
template <std::size_t Count>
void spread_outliers(const FilterChart& chart, const Outliers& outliers,
                     std::vector<FitLight<Count>>& light);

/// The same of other light, as parts of the mean of the estimates: parts add up as before.
template <std::size_t Count>
void spread_parts(const FilterChart& chart, const Outliers& outliers,
                  std::vector<FitLight<Count>>& parts);

}  // namespace lumel
