#pragma once
// What the filter of charts does within a tile of the atlas. See filter.h.
//
// [WRC88] G. J. Ward, F. M. Rubinstein, R. D. Clear. A Ray Tracing Solution for Diffuse
//         Interreflection. SIGGRAPH 1988.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "links/direct/solutions.h"

namespace lumel {

/// A step from a lumel to a neighbour. [steps] Four of the eight; the others are these, backwards.
struct Offset {
    int x, y;
};
inline constexpr std::array<Offset, 4> kSteps = {{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};

/// Square tiles, with so much around them that takes part [texels].
inline constexpr int kTile = 32, kHalo = 6, kWide = kTile + 2 * kHalo;

/// Index of a texel of a tile, -kHalo ≤ x, y < kTile + kHalo.
constexpr std::size_t wide_at(int x, int y)
{
    return std::size_t(y + kHalo) * kWide + std::size_t(x + kHalo);
}

struct FilterTile {
    template <class T>
    using Wide = std::array<T, std::size_t(kWide) * kWide>;
    using Light = std::array<Wide<float>, 3>;

    Wide<std::uint32_t> lumel;  ///< kNoLumel where there is none
    Wide<std::int32_t> chart;   ///< -1 where there is none
    Wide<std::uint8_t> steps;   ///< bit s: light may mix over kSteps[s]
    Wide<float> size;           ///< [m]
    Wide<float> nearest;        ///< [m] to what rays met
    std::array<Wide<float>, 3> centre, normal;
    std::array<Light, kSolutions> light;  ///< 0 where there is none
    std::array<Wide<float>, kSolutions>
        variance;  ///< of each of its followers, all channels together
};

/// A value of each texel within a tile, in rows.
using Inner = std::array<float, std::size_t(kTile) * kTile>;

/// Variance of the followers of solution k, from what lies around.
void find_variance(const FilterTile& tile, std::uint32_t k, Inner& variance);

/// Light that varies asks for a narrow bell. The widest is wide only where nothing is near:
/// indirect light varies over distances like those to what it comes from [WRC88].
inline constexpr std::size_t kBells = 2;

/// Sums of the followers of a solution and of their weights, for each bell.
struct FilteredTile {
    Inner weight;
    std::array<Inner, 3> one, other;
};
using FilteredTiles = std::array<std::array<FilteredTile, kSolutions>, kBells>;
void filter_tile(const FilterTile& tile, FilteredTiles& filtered);

/// Lumels within reach of the narrow bell, beside the one in its middle.
inline constexpr int kNearReach = 2;
inline constexpr std::size_t kNearWays = (2 * kNearReach + 1) * (2 * kNearReach + 1) - 1;

/// By which weights a tile's lumels mix with those at each offset, beside 1 with themselves.
struct NearWeights {
    std::array<Offset, kNearWays> to;
    std::array<Inner, kNearWays> weight;
};

/// Those of the narrow bell by which filter_tile() takes the followers of solution k.
void weigh_tile(const FilterTile& tile, std::uint32_t k, NearWeights& weights);

}  // namespace lumel
