#pragma once
// A filter over the lumels of a chart that keeps edges of light.
//
// [BCM05] A. Buades, B. Coll, J.-M. Morel. A Non-Local Algorithm for Image Denoising. CVPR 2005.
// [RKZ12] F. Rousselle, C. Knaus, M. Zwicker. Adaptive Rendering with Non-Local Means Filtering.
//         SIGGRAPH Asia 2012.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "links/cells.h"
#include "links/direct.h"

namespace lumel {

/// Estimates of one quantity at the lumels [N], independent of each other.
using Estimates = std::vector<glm::vec3>;

/// Averages lumels with others around them on their chart that look alike in a guide [RKZ12]: not
/// where their normals or sizes differ, geometry cuts them, or something stands between.
class ChartFilter {
public:
    /// What is given must outlive it. nearest [N] [m]: how near a lumel's rays met anything.
    ChartFilter(const LinkScene& place, const WorldLumels& world, const LumelParts& parts,
                const std::vector<float>& nearest);

    /// Filters both by the same weights, which come from the guide alone but for its variance, that
    /// is taken from the difference of the two.
    void filter(const Estimates& guide, const Estimates& one, const Estimates& other,
                Estimates& filtered_one, Estimates& filtered_other) const;

private:
    struct Guide;

    std::uint32_t neighbour(std::size_t lumel, int dx, int dy) const;
    bool may_mix(std::size_t i, std::size_t j) const;
    float weight(const Guide& guide, std::size_t i, std::size_t j, int dx, int dy) const;

    const LinkScene place_;
    const WorldLumels& world_;
    const LumelParts& parts_;
    const std::vector<float>& nearest_;
    std::vector<std::uint32_t> by_side_;  ///< [texels][2]
};

}  // namespace lumel
