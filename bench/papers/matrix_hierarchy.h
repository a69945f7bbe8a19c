#pragma once
// A color matrix in a hierarchy of blocks, those of low rank as products [PBSM22].

#include "solve/matrix/color_matrix.h"
#include "solve/matrix/elements.h"

namespace lumel::bench {

/// Rows and columns by place in `order`. Values are half floats: of low rank U [rows][rank], then
/// V^T [rank][columns]; else [rows][columns].
struct HierarchyBlock {
    std::uint32_t row = 0, rows = 0, column = 0, columns = 0;
    std::uint32_t rank = 0;   ///< 0: dense
    std::uint32_t first = 0;  ///< of its values
};

/// M_c = D^-1 K_c D C: colours C, D = √area. What no block of K_c covers is 0.
struct HierarchicalMatrix {
    std::uint32_t size = 0;
    std::vector<std::uint32_t> order;                   ///< [size] patch at each place
    std::array<std::vector<HierarchyBlock>, 3> blocks;  ///< of each channel
    std::array<std::vector<std::uint16_t>, 3> values;   ///< half floats
    std::array<float, 3> unit{};                        ///< of a half float 1, but in U
    std::vector<glm::vec3> color;                       ///< [size]
    std::vector<float> root_area;                       ///< [size]

    std::size_t bytes() const;
};

/// error: of K_c, Frobenius norm relative to its own; each block has its share by its entries.
/// Throws Error{input} if elements are missing.
HierarchicalMatrix compress_hierarchy(const ColorMatrix& matrix, const Elements& elements,
                                      float error);
ColorMatrix decompress(const HierarchicalMatrix& compressed);

}  // namespace lumel::bench
