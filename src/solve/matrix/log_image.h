#pragma once
// A color matrix as an image of logarithms, its largest entries apart [SF17 section 3.5].

#include <span>
#include <utility>

#include "base/core/parallel.h"
#include "solve/matrix/bc1_blocks.h"
#include "solve/matrix/color_matrix.h"
#include "solve/matrix/reorder.h"
#include "solve/matrix/sparse_part.h"

namespace lumel {

struct LogOptions {
    float exact_share = 0.04f;  ///< of each row of each channel, kept as it is; 0…1
    float offset = 25.0f;       ///< entries below e^-offset of the largest become 0
    Reordering reordering = Reordering::rows_and_columns;
    /// True: the exact part stores the difference from what its texel decodes to. The texel holds
    /// the largest other entry of its row, and BC1 does not count its error. False, as the paper
    /// writes: the image stores 0 there, and what the block decodes to is added to the exact entry.
    bool mend = true;
    /// BC1: rounding errors are carried along rows, so that the sums of rows stay right.
    bool spread = true;
};

/// Codes 0…255: channels [side][side], filled up with 0 to whole blocks.
struct LogImage {
    std::uint32_t side = 0;
    std::array<std::vector<float>, 3> channel;
};

/// Parameters that turn an image back into its matrix.
struct LogDecoding {
    std::uint32_t size = 0;          ///< rows of the matrix
    std::array<float, 3> largest{};  ///< of each channel, without the exact part
    float offset = 0.0f;
    /// [size] index in the matrix of a row, of its column and of their patch; or empty
    std::vector<std::uint32_t> order;
    SparsePart exact;  ///< added to the matrix, in its order

    template <class Archive>
    void state(Archive& archive)
    {
        archive(size, largest, offset, order, exact);
    }
    std::size_t bytes() const;
};

/// Code 0 stands for entries below e^-offset of the channel's largest. Throws Error{input} if the
/// matrix has more columns than 16 bits can name.
std::pair<LogImage, LogDecoding> take_logarithms(const ColorMatrix& matrix,
                                                 const LogOptions& options);

/// For LogOptions::mend: subtracts from the exact part what the image gives once it is stored.
void mend(LogDecoding& decoding, const LogImage& stored);

ColorMatrix from_logarithms(const LogImage& stored, const LogDecoding& decoding);

/// Moves the code at (order[i], order[j]) to (i, j).
LogImage reordered(const LogImage& image, std::span<const std::uint32_t> order);

/// Bits of the channels of a texel that no light passes through: of exact entries, which `mend`
/// restores, and of what fills up the image. [side][side]
std::vector<std::uint8_t> free_channels(const LogDecoding& decoding);

/// `size` filled up to a whole number of blocks.
constexpr std::uint32_t filled_up(std::uint32_t size)
{
    return (size + kBlockSide - 1) / kBlockSide * kBlockSide;
}

/// Calls body(number, texel) for every block, row by row: texel(i) is the index of its texel i.
template <class Body>
void for_blocks(std::uint32_t side, const Body& body)
{
    const std::size_t blocks = side / kBlockSide;
    parallel_for(blocks, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t column = 0; column < blocks; ++column)
                body(row * blocks + column, [&](std::size_t i) {
                    return (row * kBlockSide + i / kBlockSide) * side + column * kBlockSide +
                           i % kBlockSide;
                });
    });
}

}  // namespace lumel
