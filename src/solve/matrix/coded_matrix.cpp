// [SF17] section 3.5. The largest share of each row is kept; the rest is divided by the largest of
// its channel, ln(v) + offset is brought to 0…255 and stored in 8 bits or in texture blocks. Beyond
// the paper: half floats, BC4, exact parts that restore what their blocks lose
// (CodingOptions::mend), and rows ordered apart from columns, which a gather of x and a scatter of
// y make free.

#include "solve/matrix/coded_matrix.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/core/parallel.h"
#include "solve/matrix/half.h"
#include "solve/matrix/log_image.h"

namespace lumel {
namespace {

constexpr std::size_t kRowsPerTask = 16;

bool logarithmic(Code code)
{
    return code != Code::float32 && code != Code::float16;
}

float largest_of(const std::vector<float>& values)
{
    return values.empty() ? 0.0f : *std::max_element(values.begin(), values.end());
}

std::vector<std::uint32_t> as_is(std::uint32_t count)
{
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    return order;
}

void reorder(CodedMatrix& coded, LogImage& image, Reordering how)
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
    const LogImage image = from_words(coded.words, filled_up(coded.size), coded.code);
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
    LogImage image = log_image(rest, coded.largest, options.offset);
    reorder(coded, image, options.reordering);
    coded.words = to_words(image, coded.largest, options.offset, options.code);
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
