#pragma once
// Low-rank approximation of a color matrix, by a randomised basis [HMT11].

#include "solve/matrix/color_matrix.h"
#include "solve/matrix/elements.h"

namespace lumel::bench {

/// M_c = D^-1 U S_c U^T D C: colours C, D = √area.
struct LowRankMatrix {
    std::uint32_t size = 0, rank = 0;
    std::vector<std::uint16_t> basis;                ///< U^T, half floats [rank][size]
    std::array<std::vector<std::uint16_t>, 3> core;  ///< S_c, half floats [rank][rank]
    std::array<float, 3> unit{};                     ///< what a half float 1 means in S_c
    std::vector<glm::vec3> color;                    ///< [size]
    std::vector<float> root_area;                    ///< [size]

    std::size_t bytes() const;
};

/// rank: at most the size. Throws Error{input} if elements are missing.
LowRankMatrix compress_low_rank(const ColorMatrix& matrix, const Elements& elements,
                                std::uint32_t rank);
ColorMatrix decompress(const LowRankMatrix& compressed);

}  // namespace lumel::bench
