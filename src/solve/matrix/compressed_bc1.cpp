#include "solve/matrix/compressed_bc1.h"

#include <algorithm>

namespace lumel {
namespace {

constexpr std::size_t kBlockWords = std::tuple_size_v<BlockWords>;

std::vector<std::uint32_t> blocks_of(const LogImage& image, const Bc1Encoder& encoder)
{
    std::vector<std::uint32_t> blocks(image.channel[0].size() / kBlockTexels * kBlockWords);
    for_blocks(image.side, [&](std::size_t block, const auto& texel) {
        ColorBlock codes;
        for (std::size_t i = 0; i < kBlockTexels; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                codes[i][c] = image.channel[c][texel(i)];
        const BlockWords words = encoder.encode(codes);
        std::copy(words.begin(), words.end(), &blocks[block * kBlockWords]);
    });
    return blocks;
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
    const Bc1Encoder encoder(decoding.offset, decoding.largest);
    Bc1Matrix compressed{std::move(decoding), blocks_of(image, encoder)};
    if (options.mend)
        mend(compressed.decoding, image_of(compressed));
    return compressed;
}

ColorMatrix decompress(const Bc1Matrix& compressed)
{
    return from_logarithms(image_of(compressed), compressed.decoding);
}

}  // namespace lumel
