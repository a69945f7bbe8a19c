// The largest share of each row is kept; the rest is divided by the largest of its channel, and
// ln(v) + offset is brought to 0…255. Beyond the paper: exact parts that restore what the image
// loses (LogOptions::mend).

#include "solve/matrix/log_image.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solve/matrix/log_code.shared.h"
#include "solve/matrix/rows_per_task.h"

namespace lumel {
namespace {

float log_code(float value, float largest, float offset)
{
    if (!(value > 0.0f) || !(largest > 0.0f))
        return 0.0f;
    const float shifted = std::log(value / largest) + offset;
    return std::round(std::clamp(shifted / offset, 0.0f, 1.0f) * kLogCodes);
}

float from_log_code(float code, float largest, float offset)
{
    return code < kMinLogCode ? 0.0f : largest * std::exp(code * (offset / kLogCodes) - offset);
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

/// Sets decoding.largest.
LogImage image_of(const ColorMatrix& rest, LogDecoding& decoding)
{
    const std::size_t n = rest.size(), side = filled_up(rest.size());
    LogImage image{std::uint32_t(side), {}};
    for (int c = 0; c < 3; ++c) {
        image.channel[c].assign(side * side, 0.0f);
        for (const float value : rest.channel[c].values)
            decoding.largest[c] = std::max(decoding.largest[c], value);
        parallel_for(n, kRowsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                for (std::size_t j = 0; j < n; ++j)
                    image.channel[c][i * side + j] = log_code(rest.channel[c].values[i * n + j],
                                                              decoding.largest[c], decoding.offset);
        });
    }
    return image;
}

/// Rows of the image, or columns, for order_by_likeness: [n][3 n], all channels side by side.
/// Around their mean, so that products keep the digits of differences.
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

/// [SF17 figure 6]. The second order, by columns, replaces the first: swaps change neither the
/// distances between columns nor the patch that comes first.
void reorder(LogImage& image, LogDecoding& decoding, Reordering how)
{
    const std::uint32_t n = decoding.size;
    if (how == Reordering::none)
        return;
    const bool columns = how == Reordering::rows_and_columns;
    decoding.order = order_by_likeness(likenesses(image, n, columns), n, 3 * n);
    image = reordered(image, decoding.order);
}

/// All but the exact part.
ColorMatrix rest_of(const LogImage& image, const LogDecoding& decoding)
{
    const std::size_t n = decoding.size;
    const bool ordered = !decoding.order.empty();
    ColorMatrix matrix;
    for (int c = 0; c < 3; ++c) {
        matrix.channel[c] = {decoding.size, std::vector<float>(n * n)};
        parallel_for(n, kRowsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                for (std::size_t j = 0; j < n; ++j) {
                    const std::size_t row = ordered ? decoding.order[i] : i;
                    const std::size_t column = ordered ? decoding.order[j] : j;
                    matrix.channel[c].values[row * n + column] = from_log_code(
                        image.channel[c][i * image.side + j], decoding.largest[c], decoding.offset);
                }
        });
    }
    return matrix;
}

}  // namespace

std::size_t LogDecoding::bytes() const
{
    return order.size() * sizeof(std::uint32_t) + exact.bytes();
}

std::pair<LogImage, LogDecoding> take_logarithms(const ColorMatrix& matrix,
                                                 const LogOptions& options)
{
    LogDecoding decoding{.size = matrix.size(),
                         .offset = options.offset,
                         .exact = largest_entries(matrix, options.exact_share)};
    LogImage image = image_of(without(matrix, decoding.exact, options.mend), decoding);
    reorder(image, decoding, options.reordering);
    return {std::move(image), std::move(decoding)};
}

void mend(LogDecoding& decoding, const LogImage& stored)
{
    const ColorMatrix rest = rest_of(stored, decoding);
    for (int c = 0; c < 3; ++c)
        for (std::size_t entry = 0; entry < decoding.exact.value[c].size(); ++entry)
            decoding.exact.value[c][entry] -= rest.channel[c].at(
                std::uint32_t(entry / decoding.exact.per_row), decoding.exact.column[c][entry]);
}

ColorMatrix from_logarithms(const LogImage& stored, const LogDecoding& decoding)
{
    ColorMatrix matrix = rest_of(stored, decoding);
    if (decoding.exact.per_row > 0)
        add(matrix, decoding.exact);
    return matrix;
}

LogImage reordered(const LogImage& image, std::span<const std::uint32_t> order)
{
    LogImage result{image.side, {}};
    for (int c = 0; c < 3; ++c) {
        result.channel[c].assign(image.channel[c].size(), 0.0f);
        for (std::size_t i = 0; i < order.size(); ++i)
            for (std::size_t j = 0; j < order.size(); ++j)
                result.channel[c][i * image.side + j] =
                    image.channel[c][std::size_t(order[i]) * image.side + order[j]];
    }
    return result;
}

std::vector<std::uint8_t> free_channels(const LogDecoding& decoding)
{
    const std::size_t n = decoding.size, side = filled_up(decoding.size);
    std::vector<std::uint8_t> channels(side * side, kFreeTexel);
    std::vector<std::uint32_t> place(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        place[decoding.order.empty() ? i : decoding.order[i]] = i;
        std::fill_n(&channels[i * side], n, std::uint8_t(0));
    }
    const SparsePart& exact = decoding.exact;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t entry = 0; entry < exact.column[c].size(); ++entry) {
            const std::size_t row = place[entry / exact.per_row];
            channels[row * side + place[exact.column[c][entry]]] |= std::uint8_t(1u << c);
        }
    return channels;
}

}  // namespace lumel
