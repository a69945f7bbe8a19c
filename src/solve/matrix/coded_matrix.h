#pragma once
// A color matrix whose entries are stored with fewer bits, each in its place [SF17 section 3.5].

#include "solve/matrix/color_matrix.h"
#include "solve/matrix/reorder.h"
#include "solve/matrix/sparse_part.h"

namespace lumel {

/// How an entry is stored.
enum class Code : std::uint8_t {
    float32,
    float16,  ///< of entry / largest, stretched over what a half float has
    log8,     ///< logarithm of entry / largest, 8 bits
    bc1,      ///< the same, in blocks of 4 × 4 for three channels: 4 bits for all of them
    bc4,      ///< the same, in blocks of 4 × 4 for each channel: 4 bits for each
};

struct CodingOptions {
    Code code = Code::bc1;
    float exact_share = 0.04f;  ///< of each row of each channel, kept as it is; 0…1
    float offset = 25.0f;       ///< entries below e^-offset of the largest become 0
    Reordering reordering = Reordering::rows_and_columns;
    /// True: what is kept exactly leaves no hole among its neighbours but is cut to the largest of
    /// the rest, and the exact part holds what that lacks. False, as the paper: it leaves a 0, and
    /// what becomes of that 0 in its block is added to it.
    bool mend = true;
};

/// Codes that logarithms are made for have `exact` and orders; float32 and float16 have none.
struct CodedMatrix {
    Code code = Code::float32;
    std::uint32_t size = 0;
    std::array<float, 3> largest{};  ///< of each channel, without the exact part
    float offset = 0.0f;
    std::vector<std::uint32_t> row_order, column_order;  ///< the stored one's row of ours; or empty
    /// Rows and columns are filled up to multiples of 4. float32, float16, log8: row-major. Blocks:
    /// [rows / 4][columns / 4] of two words. bc1 has all channels in the first.
    std::array<std::vector<std::uint32_t>, 3> words;
    SparsePart exact;  ///< what is added, in our order

    std::size_t bytes() const;
};

/// Throws Error{input} if the matrix is too large to be named by 16 bits.
CodedMatrix encode(const ColorMatrix& matrix, const CodingOptions& options);
ColorMatrix decode(const CodedMatrix& coded);

/// Bits of an entry; of bc1, of an entry of all channels.
constexpr std::uint32_t bits_of(Code code)
{
    return code == Code::float32 ? 32u
                                 : (code == Code::float16 ? 16u : (code == Code::log8 ? 8u : 4u));
}

/// `size` filled up to a whole number of blocks.
constexpr std::uint32_t filled_up(std::uint32_t size)
{
    return (size + 3) / 4 * 4;
}

}  // namespace lumel
