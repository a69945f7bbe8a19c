#pragma once
// A filter over the lumels of a chart that keeps edges of light.
//
// [BCM05] A. Buades, B. Coll, J.-M. Morel. A Non-Local Algorithm for Image Denoising. CVPR 2005.
// [RKZ12] F. Rousselle, C. Knaus, M. Zwicker. Adaptive Rendering with Non-Local Means Filtering.
//         SIGGRAPH Asia 2012.

#include <array>
#include <cstdint>
#include <vector>

#include "atlas/cells/cells.h"
#include "links/direct/direct.h"
#include "links/direct/solutions.h"
#include "links/filter/mean.h"

namespace lumel {

struct FilterTile;

/// Averages lumels with others around them on their chart that look alike in a guide [RKZ12]: not
/// where their normals or sizes differ, geometry cuts them, or something stands between.
class ChartFilter {
public:
    /// What is given must outlive it. nearest [N] [m]: how near a lumel's rays met
    /// anything.
    ChartFilter(const LinkScene& place, const WorldLumels& world, const SubLumels& parts,
                const std::vector<float>& nearest);

    /// Bytes of it, and of what filter() returns.
    static std::uint64_t bytes(std::size_t lumels, std::size_t texels);

    /// For each width of the filter, narrowest first. Solution k filters its followers, k + 1 and
    /// k + 2, by the same weights, which come from solution k alone, but for its variance, that is
    /// taken from the difference of the two. Lumels without light stay dark.
    std::vector<Mean> filter(const Solutions& found) const;

private:
    std::uint32_t lumel_at(int x, int y, int side) const;
    std::uint8_t find_steps(std::size_t lumel) const;
    bool may_step(std::size_t i, std::size_t j, float nearest) const;
    bool fill(FilterTile& tile, int left, int top, int side, const Solutions& found) const;
    template <class Visit>
    void for_each_tile(const Solutions& found, const Visit& visit) const;

    const LinkScene place_;
    const WorldLumels& world_;
    const SubLumels& parts_;
    std::vector<std::uint32_t> by_side_;  ///< [texels][2]
    const std::vector<float>& nearest_;
    std::vector<std::uint8_t> steps_;  ///< [N] bit s: light may mix over kSteps[s]
};

}  // namespace lumel
