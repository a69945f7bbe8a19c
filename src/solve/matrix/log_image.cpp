#include "solve/matrix/log_image.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/core/parallel.h"
#include "solve/matrix/bc1_logarithms.h"
#include "solve/matrix/block_codes.h"
#include "solve/matrix/log_code.shared.h"

namespace lumel {
namespace {

constexpr std::size_t kRowsPerTask = 16;

using Words = std::array<std::vector<std::uint32_t>, 3>;

float log_code(float value, float largest, float offset)
{
    if (!(value > 0.0f) || !(largest > 0.0f))
        return 0.0f;
    const float shifted = std::log(value / largest) + offset;
    return std::round(std::clamp(shifted / offset, 0.0f, 1.0f) * kLogCodes);
}

/// Calls body(row, column, place of its two words) for every block.
template <class Body>
void for_blocks(std::uint32_t side, const Body& body)
{
    const std::size_t blocks = side / kBlockSide;
    parallel_for(blocks, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t column = 0; column < blocks; ++column)
                body(row * kBlockSide, column * kBlockSide, (row * blocks + column) * 2);
    });
}

/// Place of a texel of a block that begins at (row, column).
std::size_t place(std::uint32_t side, std::size_t row, std::size_t column, std::size_t texel)
{
    return (row + texel / kBlockSide) * side + column + texel % kBlockSide;
}

void store_bc1(Words& words, const LogImage& image, const LogarithmsInBc1& encoder)
{
    words[0].resize(image.channel[0].size() / 8);
    for_blocks(image.side, [&](std::size_t row, std::size_t column, std::size_t at) {
        ColorBlock block;
        for (std::size_t i = 0; i < kBlockTexels; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                block[i][c] = image.channel[c][place(image.side, row, column, i)];
        const BlockWords found = encoder.encode(block);
        std::copy(found.begin(), found.end(), words[0].begin() + std::ptrdiff_t(at));
    });
}

void store_bc4(Words& words, const LogImage& image)
{
    for (int c = 0; c < 3; ++c) {
        words[c].resize(image.channel[c].size() / 8);
        for_blocks(image.side, [&](std::size_t row, std::size_t column, std::size_t at) {
            GrayBlock block;
            for (std::size_t i = 0; i < kBlockTexels; ++i)
                block[i] = image.channel[c][place(image.side, row, column, i)];
            const BlockWords found = encode_bc4(block);
            std::copy(found.begin(), found.end(), words[c].begin() + std::ptrdiff_t(at));
        });
    }
}

void store_log8(Words& words, const LogImage& image)
{
    for (int c = 0; c < 3; ++c) {
        const std::vector<float>& texels = image.channel[c];
        words[c].resize(texels.size() / 4);
        for (std::size_t word = 0; word < words[c].size(); ++word)
            for (std::size_t byte = 0; byte < 4; ++byte)
                words[c][word] |= std::uint32_t(texels[word * 4 + byte]) << (8 * byte);
    }
}

}  // namespace

float from_log_code(float code, float largest, float offset)
{
    return code < kMinLogCode ? 0.0f : largest * std::exp(code * (offset / kLogCodes) - offset);
}

LogImage log_image(const ColorMatrix& rest, const std::array<float, 3>& largest, float offset)
{
    const std::size_t n = rest.size(), side = filled_up(rest.size());
    LogImage image{std::uint32_t(side), {}};
    for (int c = 0; c < 3; ++c) {
        image.channel[c].assign(side * side, 0.0f);
        parallel_for(n, kRowsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                for (std::size_t j = 0; j < n; ++j)
                    image.channel[c][i * side + j] =
                        log_code(rest.channel[c].values[i * n + j], largest[c], offset);
        });
    }
    return image;
}

// All channels side by side. Around their mean, so that products keep the digits of differences.
std::vector<float> likenesses(const LogImage& image, std::uint32_t n, bool columns)
{
    std::vector<float> rows(std::size_t(n) * n * 3);
    double sum = 0.0;
    for (const std::vector<float>& channel : image.channel)
        sum += std::accumulate(channel.begin(), channel.end(), 0.0);
    const float mean = float(sum / double(std::max<std::size_t>(rows.size(), 1)));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t j = 0; j < n; ++j)
                rows[(i * 3 + c) * n + j] =
                    image.channel[c][columns ? j * image.side + i : i * image.side + j] - mean;
    return rows;
}

LogImage reordered(const LogImage& image, std::span<const std::uint32_t> rows,
                   std::span<const std::uint32_t> columns)
{
    LogImage result{image.side, {}};
    for (int c = 0; c < 3; ++c) {
        result.channel[c].assign(image.channel[c].size(), 0.0f);
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t j = 0; j < columns.size(); ++j)
                result.channel[c][i * image.side + j] =
                    image.channel[c][std::size_t(rows[i]) * image.side + columns[j]];
    }
    return result;
}

Words to_words(const LogImage& image, const std::array<float, 3>& largest, float offset, Code code)
{
    Words words;
    if (code == Code::bc1)
        store_bc1(words, image, LogarithmsInBc1(offset, largest));
    else if (code == Code::bc4)
        store_bc4(words, image);
    else
        store_log8(words, image);
    return words;
}

LogImage from_words(const Words& words, std::uint32_t side, Code code)
{
    LogImage image{side, {}};
    for (std::vector<float>& channel : image.channel)
        channel.resize(std::size_t(side) * side);
    if (code == Code::log8) {
        for (int c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < image.channel[c].size(); ++i)
                image.channel[c][i] = float(words[c][i / 4] >> (8 * (i % 4)) & 255u);
        return image;
    }
    for_blocks(side, [&](std::size_t row, std::size_t column, std::size_t at) {
        const auto block = [&](int c) { return BlockWords{words[c][at], words[c][at + 1]}; };
        if (code == Code::bc1) {
            const ColorBlock texels = decode_bc1(block(0));
            for (std::size_t i = 0; i < kBlockTexels; ++i)
                for (std::size_t c = 0; c < 3; ++c)
                    image.channel[c][place(side, row, column, i)] = texels[i][c];
        } else {
            for (int c = 0; c < 3; ++c) {
                const GrayBlock texels = decode_bc4(block(c));
                for (std::size_t i = 0; i < kBlockTexels; ++i)
                    image.channel[c][place(side, row, column, i)] = texels[i];
            }
        }
    });
    return image;
}

}  // namespace lumel
