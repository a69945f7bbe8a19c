#pragma once
// A color matrix as the paper stores it: logarithms in a texture of BC1 blocks, patches reordered,
// the largest entries apart [SF17 section 3.5].

#include "solve/matrix/log_image.h"

namespace lumel {

struct Bc1Matrix {
    LogDecoding decoding;
    /// [filled_up(size) / 4][filled_up(size) / 4] of two words, low word first.
    std::vector<std::uint32_t> blocks;

    template <class Archive>
    void state(Archive& archive)
    {
        archive(decoding, blocks);
    }
    std::size_t bytes() const { return blocks.size() * sizeof(std::uint32_t) + decoding.bytes(); }
};

/// Throws Error{input} if the matrix has more columns than 16 bits can name.
Bc1Matrix compress_bc1(const ColorMatrix& matrix, const LogOptions& options);
ColorMatrix decompress(const Bc1Matrix& compressed);

/// The texture, decoded.
LogImage image_of(const Bc1Matrix& compressed);

}  // namespace lumel
