#include "solve/matrix/compressed_bc1.h"

#include <algorithm>

namespace lumel {
namespace {

constexpr std::size_t kBlockWords = std::tuple_size_v<BlockWords>;

/// Rows of blocks from left to right, so that a row's errors can be carried along.
std::vector<std::uint32_t> blocks_of(const LogImage& image, const LogDecoding& decoding,
                                     const LogOptions& options)
{
    const Bc1Encoder encoder(decoding.offset, decoding.largest);
    const std::vector<std::uint8_t> free =
        options.mend ? free_channels(decoding) : std::vector<std::uint8_t>();
    const std::size_t side = image.side, blocks = side / kBlockSide;
    std::vector<std::uint32_t> words(blocks * blocks * kBlockWords);
    parallel_for(blocks, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) {
            RowErrors carried{};
            for (std::size_t column = 0; column < blocks; ++column) {
                ColorBlock codes;
                FreeChannels free_here{};
                for (std::size_t i = 0; i < kBlockTexels; ++i) {
                    const std::size_t texel = (row * kBlockSide + i / kBlockSide) * side +
                                              column * kBlockSide + i % kBlockSide;
                    for (std::size_t c = 0; c < 3; ++c)
                        codes[i][c] = image.channel[c][texel];
                    if (!free.empty())
                        free_here[i] = free[texel];
                }
                const BlockWords found =
                    encoder.encode(codes, free_here, options.spread ? &carried : nullptr);
                std::copy(found.begin(), found.end(),
                          &words[(row * blocks + column) * kBlockWords]);
            }
        }
    });
    return words;
}

}  // namespace

LogImage image_of(const Bc1Matrix& compressed)
{
    LogImage image{filled_up(compressed.decoding.size), {}};
    for (std::vector<float>& channel : image.channel)
        channel.resize(std::size_t(image.side) * image.side);
    for_blocks(image.side, [&](std::size_t block, const auto& texel) {
        const std::uint32_t* words = &compressed.blocks[block * kBlockWords];
        const ColorBlock codes = decode_bc1({words[0], words[1]});
        for (std::size_t i = 0; i < kBlockTexels; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                image.channel[c][texel(i)] = codes[i][c];
    });
    return image;
}

Bc1Matrix compress_bc1(const ColorMatrix& matrix, const LogOptions& options)
{
    auto [image, decoding] = take_logarithms(matrix, options);
    Bc1Matrix compressed{.decoding = std::move(decoding), .blocks = {}};
    compressed.blocks = blocks_of(image, compressed.decoding, options);
    if (options.mend)
        mend(compressed.decoding, image_of(compressed));
    return compressed;
}

ColorMatrix decompress(const Bc1Matrix& compressed)
{
    return from_logarithms(image_of(compressed), compressed.decoding);
}

}  // namespace lumel
