#pragma once
// Light of rare rays: single lumels that are many times brighter than all around them.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "links/filter/filter_chart.h"
#include "links/filter/fit_level.h"

namespace lumel {

/// A lumel where a ray of one estimate hit a small bright surface, which few rays hit. Its light
/// belongs to all lumels around: their rays hit the surface as rarely.
struct Outlier {
    std::uint32_t texel;     ///< of the chart
    std::uint32_t estimate;  ///< with that ray
    std::uint32_t spread;    ///< number of lumels that share the light
    float share;             ///< of the estimate's light at the lumel that they share
    glm::vec3 of_sum;        ///< that light, relative to the sum of all estimates
};

struct Outliers {
    std::vector<Outlier> all;
    /// [texels] Luminance of the mean of all estimates, without what outliers give. Lumels get
    /// their light in proportion to it.
    std::vector<float> luminance;
};

/// Finds lumels that are many times brighter in one estimate than in the others, than the lumels
/// around, and than any neighbour in all estimates.
template <std::size_t Count>
Outliers find_outliers(const FilterChart& chart, const std::vector<FitLight<Count>>& light);

/// Shares the light of outliers among the nearest lumels along open steps.
template <std::size_t Count>
void spread_outliers(const FilterChart& chart, const Outliers& outliers,
                     std::vector<FitLight<Count>>& light);

/// Shares the light of parts, such as that of single lamps, in the same way: they still add up to
/// the mean of the estimates.
template <std::size_t Count>
void spread_parts(const FilterChart& chart, const Outliers& outliers,
                  std::vector<FitLight<Count>>& parts);

}  // namespace lumel
