// As in [PBSM22]: blocks are quartered down to leaves, and each is stored in the smallest of the
// forms that keep its error: nothing, low rank, its four quarters, or, of a leaf, all entries.
// Differs: matrices of low rank are crosses of the largest entries that are left instead of
// singular vectors, the matrix is that of all reflections, and leaves are not sparse.

#include "bench/papers/matrix_hierarchy.h"

#include <algorithm>
#include <cmath>

#include "base/core/parallel.h"
#include "solve/matrix/balanced.h"
#include "solve/matrix/clusters.h"
#include "solve/matrix/half.h"

namespace lumel::bench {
namespace {

constexpr std::uint32_t kLeaf = 32;    ///< largest side of a dense block
constexpr std::uint32_t kRoot = 1024;  ///< largest side of a block that may be of low rank

/// A part of a channel of K, in places.
struct Region {
    const SquareMatrix* matrix;
    std::uint32_t row, rows, column, columns;

    const float* line(std::uint32_t i) const
    {
        return &matrix->values[std::size_t(row + i) * matrix->size + column];
    }
    std::size_t entries() const { return std::size_t(rows) * columns; }
};

struct Stored {
    std::vector<HierarchyBlock> blocks;
    std::vector<float> values;
};

/// A ≈ U V^T
struct Cross {
    std::vector<float> u, v;  ///< [rank][rows], [rank][columns]
    std::uint32_t rank = 0;
    bool near = false;  ///< Σ e² is at most what is allowed
};

/// Takes the cross through the largest entry from what is left, again and again.
Cross crosses(const Region& region, double allowed, std::uint32_t most)
{
    std::vector<float> left;
    left.reserve(region.entries());
    for (std::uint32_t i = 0; i < region.rows; ++i)
        left.insert(left.end(), region.line(i), region.line(i) + region.columns);
    Cross found;
    const std::size_t columns = region.columns;
    for (;; ++found.rank) {
        double squares = 0.0;
        std::size_t pivot = 0;
        for (std::size_t k = 0; k < left.size(); ++k) {
            squares += double(left[k]) * double(left[k]);
            if (std::abs(left[k]) > std::abs(left[pivot]))
                pivot = k;
        }
        found.near = squares <= allowed;
        if (found.near || found.rank == most)
            return found;
        const std::size_t row = pivot / columns, column = pivot % columns;
        const float* v = &left[row * columns];
        found.v.insert(found.v.end(), v, v + columns);
        const float largest = left[pivot];
        for (std::size_t i = 0; i < region.rows; ++i)
            found.u.push_back(left[i * columns + column] / largest);
        const float* u = &found.u[found.rank * std::size_t(region.rows)];
        v = &found.v[found.rank * columns];
        for (std::size_t i = 0; i < region.rows; ++i)
            for (std::size_t j = 0; j < columns; ++j)
                left[i * columns + j] -= u[i] * v[j];
    }
}

HierarchyBlock block_of(const Region& region, std::uint32_t rank)
{
    return {region.row, region.rows, region.column, region.columns, rank, 0};
}

void append(Stored& all, const Stored& part)
{
    for (HierarchyBlock block : part.blocks) {
        block.first += std::uint32_t(all.values.size());
        all.blocks.push_back(block);
    }
    all.values.insert(all.values.end(), part.values.begin(), part.values.end());
}

/// allowed: Σ e² for each entry.
Stored stored(const Region& region, double allowed)
{
    Stored result;
    const bool leaf = std::max(region.rows, region.columns) <= kLeaf;
    if (leaf) {
        result.blocks = {block_of(region, 0)};
        for (std::uint32_t i = 0; i < region.rows; ++i)
            result.values.insert(result.values.end(), region.line(i),
                                 region.line(i) + region.columns);
    } else {
        const std::uint32_t rows = region.rows / 2, columns = region.columns / 2;
        for (const std::uint32_t down : {0u, 1u})
            for (const std::uint32_t right : {0u, 1u}) {
                Region quarter = region;
                quarter.row += down * rows;
                quarter.rows = down ? region.rows - rows : rows;
                quarter.column += right * columns;
                quarter.columns = right ? region.columns - columns : columns;
                if (quarter.entries() > 0)
                    append(result, stored(quarter, allowed));
            }
    }
    // Of low rank only if that is smaller.
    const std::uint32_t side = region.rows + region.columns;
    const auto most = std::uint32_t((std::max<std::size_t>(result.values.size(), 1) - 1) / side);
    const Cross cross = crosses(region, allowed * double(region.entries()), most);
    if (!cross.near)
        return result;
    if (cross.rank == 0)
        return {};
    result = {{block_of(region, cross.rank)}, {}};
    for (std::size_t i = 0; i < region.rows; ++i)
        for (std::size_t k = 0; k < cross.rank; ++k)
            result.values.push_back(cross.u[k * region.rows + i]);
    result.values.insert(result.values.end(), cross.v.begin(), cross.v.end());
    return result;
}

SquareMatrix in_order(const SquareMatrix& matrix, const std::vector<std::uint32_t>& order)
{
    SquareMatrix result = matrix;
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = 0; j < order.size(); ++j)
            result.values[i * order.size() + j] = matrix.at(order[i], order[j]);
    return result;
}

Stored channel_of(const SquareMatrix& matrix, float error)
{
    double squares = 0.0;
    for (const float value : matrix.values)
        squares += double(value) * double(value);
    const double entries = double(matrix.size) * double(matrix.size);
    const double allowed = double(error) * double(error) * squares / entries;
    const std::uint32_t roots = (matrix.size + kRoot - 1) / kRoot;
    std::vector<Stored> parts(std::size_t(roots) * roots);
    parallel_for(parts.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t part = first; part < last; ++part) {
            const std::uint32_t row = std::uint32_t(part / roots) * kRoot;
            const std::uint32_t column = std::uint32_t(part % roots) * kRoot;
            parts[part] = stored({&matrix, row, std::min(kRoot, matrix.size - row), column,
                                  std::min(kRoot, matrix.size - column)},
                                 allowed);
        }
    });
    Stored all;
    for (const Stored& part : parts)
        append(all, part);
    return all;
}

/// U of a block of low rank: its values are at most 1, and have no unit.
std::size_t plain_values(const HierarchyBlock& block)
{
    return std::size_t(block.rows) * block.rank;
}

}  // namespace

std::size_t HierarchicalMatrix::bytes() const
{
    std::size_t count = order.size() * sizeof(std::uint32_t) + color.size() * sizeof(glm::vec3) +
                        root_area.size() * sizeof(float);
    for (std::size_t c = 0; c < 3; ++c)
        count +=
            blocks[c].size() * sizeof(HierarchyBlock) + values[c].size() * sizeof(std::uint16_t);
    return count;
}

HierarchicalMatrix compress_hierarchy(const ColorMatrix& matrix, const Elements& elements,
                                      float error)
{
    HierarchicalMatrix result{.size = matrix.size(),
                              .order = cluster_order(elements, kLeaf),
                              .color = elements.color,
                              .root_area = root_areas(elements)};
    const ColorMatrix balance = balanced(matrix, elements);
    for (std::size_t c = 0; c < 3; ++c) {
        Stored channel = channel_of(in_order(balance.channel[c], result.order), error);
        result.unit[c] = half_unit(channel.values);
        result.values[c].resize(channel.values.size());
        std::size_t at = 0;
        for (const HierarchyBlock& block : channel.blocks) {
            const std::size_t plain = plain_values(block);
            const std::size_t count =
                plain + std::size_t(block.rank > 0 ? block.rank : block.rows) * block.columns;
            for (std::size_t k = 0; k < count; ++k, ++at)
                result.values[c][at] =
                    to_half(k < plain ? channel.values[at] : channel.values[at] / result.unit[c]);
        }
        result.blocks[c] = std::move(channel.blocks);
    }
    return result;
}

ColorMatrix decompress(const HierarchicalMatrix& compressed)
{
    const std::size_t n = compressed.size;
    ColorMatrix balance;
    for (std::size_t c = 0; c < 3; ++c) {
        balance.channel[c] = {compressed.size, std::vector<float>(n * n, 0.0f)};
        for (const HierarchyBlock& block : compressed.blocks[c]) {
            const std::uint16_t* values = &compressed.values[c][block.first];
            const std::uint16_t* right = values + plain_values(block);
            for (std::size_t i = 0; i < block.rows; ++i)
                for (std::size_t j = 0; j < block.columns; ++j) {
                    float sum = block.rank > 0 ? 0.0f : from_half(values[i * block.columns + j]);
                    for (std::size_t k = 0; k < block.rank; ++k)
                        sum += from_half(values[i * block.rank + k]) *
                               from_half(right[k * block.columns + j]);
                    balance.channel[c].values[compressed.order[block.row + i] * n +
                                              compressed.order[block.column + j]] =
                        compressed.unit[c] * sum;
                }
        }
    }
    return unbalanced(balance, compressed.color, compressed.root_area);
}

}  // namespace lumel::bench
