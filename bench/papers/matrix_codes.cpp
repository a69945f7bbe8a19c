#include "bench/papers/matrix_codes.h"

#include <algorithm>
#include <bit>

#include "base/core/parallel.h"
#include "bench/papers/matrix_blocks.h"
#include "solve/matrix/half.h"

namespace lumel::bench {
namespace {

constexpr std::size_t kRowsPerTask = 16;

using Words = std::array<std::vector<std::uint32_t>, 3>;

bool logarithmic(Code code)
{
    return code != Code::float32 && code != Code::float16;
}

/// Stores a block in its two words.
void put(std::vector<std::uint32_t>& words, std::size_t block, const BlockWords& found)
{
    std::copy(found.begin(), found.end(), &words[block * found.size()]);
}

BlockWords block_at(const std::vector<std::uint32_t>& words, std::size_t block)
{
    return {words[2 * block], words[2 * block + 1]};
}

void store_bc1(Words& words, const LogImage& image)
{
    words[0].resize(image.channel[0].size() / 8);
    for_blocks(image.side, [&](std::size_t block, const auto& texel) {
        ColorBlock codes;
        for (std::size_t i = 0; i < kBlockTexels; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                codes[i][c] = image.channel[c][texel(i)];
        put(words[0], block, encode_bc1(codes));
    });
}

void store_bc4(Words& words, const LogImage& image)
{
    for (std::size_t c = 0; c < 3; ++c) {
        words[c].resize(image.channel[c].size() / 8);
        for_blocks(image.side, [&](std::size_t block, const auto& texel) {
            GrayBlock codes;
            for (std::size_t i = 0; i < kBlockTexels; ++i)
                codes[i] = image.channel[c][texel(i)];
            put(words[c], block, encode_bc4(codes));
        });
    }
}

void store_log8(Words& words, const LogImage& image)
{
    for (std::size_t c = 0; c < 3; ++c) {
        const std::vector<float>& texels = image.channel[c];
        words[c].resize(texels.size() / 4);
        for (std::size_t word = 0; word < words[c].size(); ++word)
            for (std::size_t byte = 0; byte < 4; ++byte)
                words[c][word] |= std::uint32_t(texels[word * 4 + byte]) << (8 * byte);
    }
}

void load_log8(LogImage& image, const Words& words)
{
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < image.channel[c].size(); ++i)
            image.channel[c][i] = float(words[c][i / 4] >> (8 * (i % 4)) & 255u);
}

void load_bc4(LogImage& image, const Words& words)
{
    for (std::size_t c = 0; c < 3; ++c)
        for_blocks(image.side, [&](std::size_t block, const auto& texel) {
            const GrayBlock codes = decode_bc4(block_at(words[c], block));
            for (std::size_t i = 0; i < kBlockTexels; ++i)
                image.channel[c][texel(i)] = codes[i];
        });
}

void encode_logarithms(CodedMatrix& coded, const ColorMatrix& matrix, const CodingOptions& options)
{
    const LogOptions logarithms{.exact_share = options.exact_share,
                                .offset = options.offset,
                                .reordering = options.reordering,
                                .mend = options.mend,
                                .spread = options.spread};
    if (options.code == Code::bc1) {
        Bc1Matrix bc1 = compress_bc1(matrix, logarithms);
        coded.decoding = std::move(bc1.decoding);
        coded.words[0] = std::move(bc1.blocks);
        return;
    }
    LogImage image;
    std::tie(image, coded.decoding) = take_logarithms(matrix, logarithms);
    if (options.code == Code::bc1_of_codes)
        store_bc1(coded.words, image);
    else if (options.code == Code::bc4)
        store_bc4(coded.words, image);
    else
        store_log8(coded.words, image);
    if (options.mend)
        mend(coded.decoding, image_of(coded));
}

void encode_floats(CodedMatrix& coded, const ColorMatrix& matrix)
{
    const std::size_t n = matrix.size(), side = filled_up(matrix.size());
    const bool half = coded.code == Code::float16;
    coded.decoding.size = matrix.size();
    for (int c = 0; c < 3; ++c) {
        const std::vector<float>& values = matrix.channel[c].values;
        const float unit = half_unit(values);
        coded.decoding.largest[c] = unit * kLargestHalf;
        std::vector<std::uint32_t>& words = coded.words[c];
        words.assign(side * side / (half ? 2 : 1), 0u);
        parallel_for(n, kRowsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                for (std::size_t j = 0; j < n; ++j) {
                    const float value = values[i * n + j];
                    const std::size_t at = i * side + j;
                    if (half)
                        words[at / 2] |= std::uint32_t(to_half(value / unit)) << (16 * (at % 2));
                    else
                        words[at] = std::bit_cast<std::uint32_t>(value);
                }
        });
    }
}

ColorMatrix decode_floats(const CodedMatrix& coded)
{
    const std::size_t n = coded.decoding.size, side = filled_up(coded.decoding.size);
    ColorMatrix matrix;
    for (int c = 0; c < 3; ++c) {
        matrix.channel[c] = {coded.decoding.size, std::vector<float>(n * n)};
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                const std::size_t at = i * side + j;
                const std::uint32_t word =
                    coded.words[c][coded.code == Code::float16 ? at / 2 : at];
                matrix.channel[c].values[i * n + j] =
                    coded.code == Code::float32
                        ? std::bit_cast<float>(word)
                        : from_half(std::uint16_t(word >> (16 * (at % 2)) & 0xffffu)) *
                              (coded.decoding.largest[c] / kLargestHalf);
            }
    }
    return matrix;
}

}  // namespace

std::size_t CodedMatrix::bytes() const
{
    std::size_t count = 0;
    for (const std::vector<std::uint32_t>& plane : words)
        count += plane.size() * sizeof(std::uint32_t);
    return count + decoding.bytes();
}

CodedMatrix encode(const ColorMatrix& matrix, const CodingOptions& options)
{
    CodedMatrix coded{.code = options.code, .decoding = {}, .words = {}};
    if (logarithmic(options.code))
        encode_logarithms(coded, matrix, options);
    else
        encode_floats(coded, matrix);
    return coded;
}

ColorMatrix decode(const CodedMatrix& coded)
{
    return logarithmic(coded.code) ? from_logarithms(image_of(coded), coded.decoding)
                                   : decode_floats(coded);
}

LogImage image_of(const CodedMatrix& coded)
{
    if (is_bc1(coded.code))
        return lumel::image_of({coded.decoding, coded.words[0]});
    LogImage image{filled_up(coded.decoding.size), {}};
    for (std::vector<float>& channel : image.channel)
        channel.resize(std::size_t(image.side) * image.side);
    if (coded.code == Code::bc4)
        load_bc4(image, coded.words);
    else
        load_log8(image, coded.words);
    return image;
}

}  // namespace lumel::bench
