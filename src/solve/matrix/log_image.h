#pragma once
// A color matrix as a picture of its logarithms, 0…255, in 8 bits or in texture blocks.

#include <span>

#include "solve/matrix/coded_matrix.h"

namespace lumel {

/// Channels [side][side], filled up with 0 to whole blocks.
struct LogImage {
    std::uint32_t side = 0;
    std::array<std::vector<float>, 3> channel;
};

/// 0 for what is less than e^-offset of the channel's largest.
LogImage log_image(const ColorMatrix& matrix, const std::array<float, 3>& largest, float offset);

/// The entry that a code stands for.
float from_log_code(float code, float largest, float offset);

/// Likenesses of the image's first n rows, or columns, for order_by_likeness: [n][3 n].
std::vector<float> likenesses(const LogImage& image, std::uint32_t n, bool columns);

/// Place (i, j) gets what was at (rows[i], columns[j]).
LogImage reordered(const LogImage& image, std::span<const std::uint32_t> rows,
                   std::span<const std::uint32_t> columns);

/// Words of a matrix in one of the codes log8, bc1 and bc4; and back, as near as they are.
/// largest, offset: as log_image() was given them.
std::array<std::vector<std::uint32_t>, 3>
to_words(const LogImage& image, const std::array<float, 3>& largest, float offset, Code code);
LogImage from_words(const std::array<std::vector<std::uint32_t>, 3>& words, std::uint32_t side,
                    Code code);

}  // namespace lumel
