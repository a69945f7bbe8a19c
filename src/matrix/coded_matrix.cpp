// [SF17] section 3.5. The largest share of each row is kept; the rest is divided by the largest of
// its channel, ln(v) + offset is brought to 0…255 and stored in 8 bits or in texture blocks. Beyond
// the paper: half floats, BC4, exact parts that mend what their blocks lose (CodingOptions::mend),
// and rows ordered apart from columns, which a gather of x and a scatter of y make free.

#include "matrix/coded_matrix.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "matrix/block_codes.h"
#include "matrix/half.h"
#include "matrix/log_code.shared.h"

namespace lumel {
namespace {

constexpr std::size_t kRowsPerTask = 16;

/// Channels of logarithms 0…255, filled up with 0.
struct Image {
    std::uint32_t side = 0;
    std::array<std::vector<float>, 3> channel;
};

bool logarithmic(Code code)
{
    return code != Code::float32 && code != Code::float16;
}

float largest_of(const std::vector<float>& values)
{
    return values.empty() ? 0.0f : *std::max_element(values.begin(), values.end());
}

float log_code(float value, float largest, float offset)
{
    if (!(value > 0.0f) || !(largest > 0.0f))
        return 0.0f;
    const float shifted = std::log(value / largest) + offset;
    return std::round(std::clamp(shifted / offset, 0.0f, 1.0f) * kLogCodes);
}

float from_log_code(float code, float largest, float offset)
{
    return code < kLeastLogCode ? 0.0f : largest * std::exp(code * (offset / kLogCodes) - offset);
}

/// The matrix without its exact part: those entries become 0, or the largest that is left in
/// their row.
ColorMatrix without(const ColorMatrix& matrix, const SparsePart& part, bool cut)
{
    ColorMatrix rest = matrix;
    const std::size_t n = part.size, kept = part.per_row;
    for (int c = 0; c < 3; ++c)
        parallel_for(n, kRowsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const auto row = std::span(rest.channel[c].values).subspan(i * n, n);
                const auto columns = std::span(part.column[c]).subspan(i * kept, kept);
                for (const std::uint16_t column : columns)
                    row[column] = 0.0f;
                const float most = cut && n > 0 ? *std::max_element(row.begin(), row.end()) : 0.0f;
                for (const std::uint16_t column : columns)
                    row[column] = most;
            }
        });
    return rest;
}

Image logarithms(const ColorMatrix& rest, const std::array<float, 3>& largest, float offset)
{
    const std::size_t n = rest.size(), side = filled_up(rest.size());
    Image image{std::uint32_t(side), {}};
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

std::vector<std::uint32_t> as_is(std::uint32_t count)
{
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    return order;
}

/// Rows of all channels side by side, or columns, as what order_by_likeness compares. Around their
/// mean, so that products keep the digits of differences.
std::vector<float> likenesses(const Image& image, std::uint32_t n, bool columns)
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

/// Place (i, j) gets what was at (rows[i], columns[j]).
Image reordered(const Image& image, std::span<const std::uint32_t> rows,
                std::span<const std::uint32_t> columns)
{
    Image result{image.side, {}};
    for (int c = 0; c < 3; ++c) {
        result.channel[c].assign(image.channel[c].size(), 0.0f);
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t j = 0; j < columns.size(); ++j)
                result.channel[c][i * image.side + j] =
                    image.channel[c][std::size_t(rows[i]) * image.side + columns[j]];
    }
    return result;
}

void reorder(CodedMatrix& coded, Image& image, Reordering how)
{
    if (how == Reordering::none)
        return;
    const std::uint32_t n = coded.size;
    coded.column_order = as_is(n);
    coded.row_order = order_by_likeness(likenesses(image, n, false), n, 3 * n);
    if (how == Reordering::rows_and_columns)
        coded.column_order = order_by_likeness(likenesses(image, n, true), n, 3 * n);
    image = reordered(image, coded.row_order, coded.column_order);
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

void store_bc1(CodedMatrix& coded, const Image& image)
{
    coded.words[0].resize(image.channel[0].size() / 8);
    for_blocks(image.side, [&](std::size_t row, std::size_t column, std::size_t words) {
        ColorBlock block;
        for (std::size_t i = 0; i < kBlockTexels; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                block[i][c] = image.channel[c][place(image.side, row, column, i)];
        const BlockWords found = encode_bc1(block);
        std::copy(found.begin(), found.end(), coded.words[0].begin() + std::ptrdiff_t(words));
    });
}

void store_bc4(CodedMatrix& coded, const Image& image)
{
    for (int c = 0; c < 3; ++c) {
        coded.words[c].resize(image.channel[c].size() / 8);
        for_blocks(image.side, [&](std::size_t row, std::size_t column, std::size_t words) {
            GrayBlock block;
            for (std::size_t i = 0; i < kBlockTexels; ++i)
                block[i] = image.channel[c][place(image.side, row, column, i)];
            const BlockWords found = encode_bc4(block);
            std::copy(found.begin(), found.end(), coded.words[c].begin() + std::ptrdiff_t(words));
        });
    }
}

void store_log8(CodedMatrix& coded, const Image& image)
{
    for (int c = 0; c < 3; ++c) {
        const std::vector<float>& texels = image.channel[c];
        coded.words[c].resize(texels.size() / 4);
        for (std::size_t word = 0; word < coded.words[c].size(); ++word)
            for (std::size_t byte = 0; byte < 4; ++byte)
                coded.words[c][word] |= std::uint32_t(texels[word * 4 + byte]) << (8 * byte);
    }
}

Image load(const CodedMatrix& coded)
{
    const std::uint32_t side = filled_up(coded.size);
    Image image{side, {}};
    for (std::vector<float>& channel : image.channel)
        channel.resize(std::size_t(side) * side);
    if (coded.code == Code::log8) {
        for (int c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < image.channel[c].size(); ++i)
                image.channel[c][i] = float(coded.words[c][i / 4] >> (8 * (i % 4)) & 255u);
        return image;
    }
    for_blocks(side, [&](std::size_t row, std::size_t column, std::size_t words) {
        const auto block = [&](int c) {
            return BlockWords{coded.words[c][words], coded.words[c][words + 1]};
        };
        if (coded.code == Code::bc1) {
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

ColorMatrix empty_matrix(std::uint32_t size)
{
    ColorMatrix matrix;
    for (SquareMatrix& channel : matrix.channel)
        channel = {size, std::vector<float>(std::size_t(size) * size)};
    return matrix;
}

/// All but the exact part.
ColorMatrix decode_rest(const CodedMatrix& coded)
{
    const Image image = load(coded);
    ColorMatrix matrix = empty_matrix(coded.size);
    const std::size_t n = coded.size;
    const bool ordered = !coded.row_order.empty();
    for (int c = 0; c < 3; ++c)
        parallel_for(n, kRowsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                for (std::size_t j = 0; j < n; ++j) {
                    const std::size_t row = ordered ? coded.row_order[i] : i;
                    const std::size_t column = ordered ? coded.column_order[j] : j;
                    matrix.channel[c].values[row * n + column] = from_log_code(
                        image.channel[c][i * image.side + j], coded.largest[c], coded.offset);
                }
        });
    return matrix;
}

void encode_logarithms(CodedMatrix& coded, const ColorMatrix& matrix, const CodingOptions& options)
{
    coded.offset = options.offset;
    coded.exact = largest_entries(matrix, options.exact_share);
    const ColorMatrix rest = without(matrix, coded.exact, options.mend);
    for (int c = 0; c < 3; ++c)
        coded.largest[c] = largest_of(rest.channel[c].values);
    Image image = logarithms(rest, coded.largest, options.offset);
    reorder(coded, image, options.reordering);
    if (options.code == Code::bc1)
        store_bc1(coded, image);
    else if (options.code == Code::bc4)
        store_bc4(coded, image);
    else
        store_log8(coded, image);
    if (!options.mend)
        return;
    const ColorMatrix stored = decode_rest(coded);
    for (int c = 0; c < 3; ++c)
        for (std::size_t entry = 0; entry < coded.exact.value[c].size(); ++entry) {
            const std::size_t row = entry / coded.exact.per_row;
            coded.exact.value[c][entry] -=
                stored.channel[c].at(std::uint32_t(row), coded.exact.column[c][entry]);
        }
}

void encode_floats(CodedMatrix& coded, const ColorMatrix& matrix)
{
    const std::size_t n = coded.size, side = filled_up(coded.size);
    const bool half = coded.code == Code::float16;
    for (int c = 0; c < 3; ++c) {
        const std::vector<float>& values = matrix.channel[c].values;
        coded.largest[c] = half_unit(values) * kLargestHalf;
        const float unit = half_unit(values);
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
    const std::size_t n = coded.size, side = filled_up(coded.size);
    ColorMatrix matrix = empty_matrix(coded.size);
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                const std::size_t at = i * side + j;
                const std::uint32_t word =
                    coded.words[c][coded.code == Code::float16 ? at / 2 : at];
                matrix.channel[c].values[i * n + j] =
                    coded.code == Code::float32
                        ? std::bit_cast<float>(word)
                        : from_half(std::uint16_t(word >> (16 * (at % 2)) & 0xffffu)) *
                              (coded.largest[c] / kLargestHalf);
            }
    return matrix;
}

}  // namespace

std::size_t CodedMatrix::bytes() const
{
    std::size_t count = row_order.size() + column_order.size();
    for (const std::vector<std::uint32_t>& plane : words)
        count += plane.size();
    return count * sizeof(std::uint32_t) + exact.bytes();
}

CodedMatrix encode(const ColorMatrix& matrix, const CodingOptions& options)
{
    CodedMatrix coded{.code = options.code, .size = matrix.size()};
    if (logarithmic(options.code))
        encode_logarithms(coded, matrix, options);
    else
        encode_floats(coded, matrix);
    return coded;
}

ColorMatrix decode(const CodedMatrix& coded)
{
    if (!logarithmic(coded.code))
        return decode_floats(coded);
    ColorMatrix matrix = decode_rest(coded);
    if (coded.exact.per_row > 0)
        add(matrix, coded.exact);
    return matrix;
}

}  // namespace lumel
