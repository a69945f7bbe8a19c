#pragma once
// Color matrices with fewer bits for each entry, in its place: what [SF17] section 3.5 can be
// compared with. src/solve/matrix has its BC1.

#include "solve/matrix/compressed_bc1.h"

namespace lumel::bench {

/// How an entry is stored.
enum class Code : std::uint8_t {
    float32,
    float16,       ///< of entry / largest, stretched over what a half float has
    log8,          ///< logarithm of entry / largest, 8 bits
    bc1,           ///< the same, in blocks of 4 × 4 for three channels: 4 bits for all of them
    bc1_of_codes,  ///< the same, blocks made for the logarithms, not for the entries
    bc4,           ///< the same, in blocks of 4 × 4 for each channel: 4 bits for each
};

/// As LogOptions, which says what the others are.
struct CodingOptions {
    Code code = Code::bc1;
    float exact_share = 0.04f;
    float offset = 25.0f;
    Reordering reordering = Reordering::rows_and_columns;
    bool mend = true;
    bool spread = true;
};

struct CodedMatrix {
    Code code = Code::float32;
    LogDecoding decoding;  ///< float32 and float16: size and largest alone
    /// Rows and columns are filled up to multiples of 4. float32, float16, log8: row-major. Blocks:
    /// [rows / 4][columns / 4] of two words. bc1 has all channels in the first.
    std::array<std::vector<std::uint32_t>, 3> words;

    std::size_t bytes() const;
};

/// Throws Error{input} if the matrix is too large to be named by 16 bits.
CodedMatrix encode(const ColorMatrix& matrix, const CodingOptions& options);
ColorMatrix decode(const CodedMatrix& coded);

/// Codes of logarithms as they come out of the words.
LogImage image_of(const CodedMatrix& coded);

/// True if a block has all channels.
constexpr bool is_bc1(Code code)
{
    return code == Code::bc1 || code == Code::bc1_of_codes;
}

/// Bits of an entry; of bc1, of an entry of all channels.
constexpr std::uint32_t bits_of(Code code)
{
    return code == Code::float32 ? 32u
                                 : (code == Code::float16 ? 16u : (code == Code::log8 ? 8u : 4u));
}

}  // namespace lumel::bench
