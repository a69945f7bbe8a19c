#pragma once
// A balanced matrix by axes of colours, and in bases of its own for each cluster of patches.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "solve/matrix/color_matrix.h"
#include "solve/matrix/tiles.shared.h"

namespace lumel {

inline constexpr std::array<glm::vec3, 3> kColorAxes = {kGrayAxis, kRedBlueAxis, kGreenAxis};

/// Numbers of a cluster's basis.
inline constexpr std::size_t kBasis = std::size_t(kCluster) * kCluster;

/// Matrices of one side, filled up to whole clusters.
struct Coefficients {
    std::size_t side = 0;
    std::array<std::vector<float>, 3> axis;  ///< [side][side]

    std::size_t clusters() const { return side / kCluster; }
};

/// n filled up to whole clusters.
constexpr std::size_t whole_clusters(std::size_t n)
{
    return (n + kCluster - 1) / kCluster * kCluster;
}

/// K in the order of clusters, its channels as axes.
Coefficients by_axes(const ColorMatrix& balanced, std::span<const std::uint32_t> order);

/// Makes K symmetric, which rounding left it nearly.
void symmetrise(Coefficients& matrix);

/// Rows of a basis in 8 bits.
struct CodedBasis {
    std::vector<std::int8_t> codes;  ///< [rows][kCluster]
    std::vector<float> units;        ///< [rows]

    std::size_t rows() const { return units.size(); }
    float at(std::size_t row, std::size_t column) const
    {
        return float(codes[row * kCluster + column]) * units[row] / kCodes8;
    }
};

/// For each cluster the basis in which its rows of K have most energy in the first coefficients.
CodedBasis find_bases(const Coefficients& matrix);

/// Q^-T for each cluster, Q as it is stored: T = Q^-T K Q^-1. [clusters][kBasis]. Throws
/// Error{input} if a basis has lost a direction to rounding.
std::vector<float> duals(const CodedBasis& bases);

/// B K B^T in place, or B^T T B if `back`. bases: [clusters][kBasis].
void transform(std::span<const float> bases, Coefficients& matrix, bool back);

}  // namespace lumel
