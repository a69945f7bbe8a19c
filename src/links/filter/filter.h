#pragma once
// Edge-preserving filter over the lumels of a chart.
//
// [BCM05] A. Buades, B. Coll, J.-M. Morel. A Non-Local Algorithm for Image Denoising. CVPR 2005.
// [RKZ12] F. Rousselle, C. Knaus, M. Zwicker. Adaptive Rendering with Non-Local Means Filtering.
//         SIGGRAPH Asia 2012.

#include <array>
#include <cstdint>
#include <vector>

#include "links/direct/link_work.h"
#include "links/direct/solutions.h"
#include "links/filter/mean.h"

namespace lumel {

struct FilterTile;

/// Averages lumels with those around them on their chart that are similar in a guide [RKZ12]. Does
/// not mix lumels of different normal or size, or across geometry.
class ChartFilter {
public:
    /// All arguments must outlive this. nearest [N]: distance from each lumel to its nearest ray
    /// hit [m].
    ChartFilter(const LinkWork& work, const SubLumels& parts, const std::vector<float>& nearest);

    /// Memory of this and of the result of filter() [bytes].
    static std::uint64_t bytes(std::size_t lumels, std::size_t texels);

    /// Returns one Mean per filter width, narrowest first. Weights from solution k filter the
    /// cross-filtered solutions k + 1 and k + 2, so that they are independent of the filtered data;
    /// only the variance in the weights is estimated from the difference of those two. Lumels
    /// without light stay dark.
    std::vector<Mean> filter(const Solutions& found) const;

private:
    std::uint8_t find_steps(std::size_t lumel) const;
    bool may_step(std::size_t i, std::size_t j, float nearest) const;
    bool fill(FilterTile& tile, int left, int top, int side, const Solutions& found) const;
    template <class Visit>
    void for_each_tile(const Solutions& found, const Visit& visit) const;

    const LinkWork& work_;
    const SubLumels& parts_;
    std::vector<std::uint32_t> by_side_;  ///< [texels][2]
    const std::vector<float>& nearest_;
    std::vector<std::uint8_t> steps_;  ///< [N] bit s: the filter may step over kSteps[s]
};

}  // namespace lumel
