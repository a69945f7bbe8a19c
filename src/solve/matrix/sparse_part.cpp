#include "solve/matrix/sparse_part.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/core/error.h"
#include "base/core/parallel.h"
#include "solve/matrix/rows_per_task.h"

namespace lumel {
namespace {

/// Columns of the `columns.size()` largest of a row, ascending. Of equal ones the first.
void choose_largest(std::span<const float> row, std::span<std::uint16_t> columns)
{
    std::vector<std::uint32_t> order(row.size());
    std::iota(order.begin(), order.end(), 0u);
    std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(columns.size()), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         return row[a] != row[b] ? row[a] > row[b] : a < b;
                     });
    std::transform(order.begin(), order.begin() + std::ptrdiff_t(columns.size()), columns.begin(),
                   [](std::uint32_t column) { return std::uint16_t(column); });
    std::sort(columns.begin(), columns.end());
}

}  // namespace

SparsePart largest_entries(const ColorMatrix& matrix, float share)
{
    SparsePart part{.size = matrix.size()};
    if (part.size > kMaxColumns)
        throw Error(ErrorKind::input, "form-factor matrix",
                    "has " + std::to_string(part.size) + " patches, more than " +
                        std::to_string(kMaxColumns) + "; use fewer patches");
    part.per_row = std::min(part.size, std::uint32_t(std::lround(share * float(part.size))));
    const std::size_t n = part.size, kept = part.per_row;
    for (int c = 0; c < 3; ++c) {
        part.column[c].resize(n * kept);
        part.value[c].resize(n * kept);
        parallel_for(n, kRowsPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const std::span<const float> row(&matrix.channel[c].values[i * n], n);
                const auto columns = std::span(part.column[c]).subspan(i * kept, kept);
                choose_largest(row, columns);
                for (std::size_t k = 0; k < kept; ++k)
                    part.value[c][i * kept + k] = row[columns[k]];
            }
        });
    }
    return part;
}

void add(ColorMatrix& matrix, const SparsePart& part)
{
    for (int c = 0; c < 3; ++c)
        for (std::size_t entry = 0; entry < part.value[c].size(); ++entry) {
            const std::size_t row = entry / part.per_row;
            matrix.channel[c].values[row * part.size + part.column[c][entry]] +=
                part.value[c][entry];
        }
}

}  // namespace lumel
