#pragma once
// Weights that mix lumels similar in a guide, within a tile of the atlas: the filter of live
// scenes, whose weights are kept while light changes.
//
// [BCM05] A. Buades, B. Coll, J.-M. Morel. A Non-Local Algorithm for Image Denoising. CVPR 2005.
// [RKZ12] F. Rousselle, C. Knaus, M. Zwicker. Adaptive Rendering with Non-Local Means Filtering.
//         SIGGRAPH Asia 2012.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "atlas/packing/lumel.shared.h"
#include "links/direct/solutions.h"
#include "links/filter/filter_chart.h"

namespace lumel {

/// Side of a tile and width of the border around it that is read [texels].
inline constexpr int kTile = 32, kHalo = 3, kWide = kTile + 2 * kHalo;

/// Array index of a texel of a tile, -kHalo ≤ x, y < kTile + kHalo.
constexpr std::size_t wide_at(int x, int y)
{
    return std::size_t(y + kHalo) * kWide + std::size_t(x + kHalo);
}

struct FilterTile {
    template <class T>
    using Wide = std::array<T, std::size_t(kWide) * kWide>;
    using Light = std::array<Wide<float>, 3>;

    Wide<std::uint32_t> lumel;  ///< kNoLumel if none
    Wide<std::int32_t> chart;   ///< -1 if none
    Wide<std::uint8_t> steps;   ///< bit s: the filter may step over kSteps[s]
    Wide<float> size;           ///< [m]
    std::array<Wide<float>, 3> centre, normal;
    std::array<Light, kSolutions> light;  ///< 0 without a lumel
    std::array<Wide<float>, kSolutions>
        variance;  ///< per cross-filtered solution, summed over channels
};

/// Calls visit(lumel, index of an Inner, index of a Wide) for each lumel within the tile, row by
/// row.
template <class Visit>
void for_each_lumel(const FilterTile& tile, const Visit& visit)
{
    for (int y = 0; y < kTile; ++y)
        for (int x = 0; x < kTile; ++x)
            if (const std::uint32_t i = tile.lumel[wide_at(x, y)]; i != kNoLumel)
                visit(i, std::size_t(y) * kTile + std::size_t(x), wide_at(x, y));
}

/// A value for each texel within a tile, in rows.
using Inner = std::array<float, std::size_t(kTile) * kTile>;

/// Variance of the cross-filtered solutions of solution k, from neighbours.
void find_variance(const FilterTile& tile, std::uint32_t k, Inner& variance);

/// Radius of the kernel, and number of lumels in it except the central one.
inline constexpr int kNearReach = 2;
inline constexpr std::size_t kNearWays = (2 * kNearReach + 1) * (2 * kNearReach + 1) - 1;

/// Weights of a tile's lumels with those at each offset, relative to 1 for themselves.
struct NearWeights {
    std::array<Offset, kNearWays> to;
    std::array<Inner, kNearWays> weight;
};

/// Weights by solution k.
void weigh_tile(const FilterTile& tile, std::uint32_t k, NearWeights& weights);

}  // namespace lumel
