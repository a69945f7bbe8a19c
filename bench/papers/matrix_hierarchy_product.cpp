#include "bench/papers/matrix_hierarchy_product.h"

#include <cassert>

#include "solve/matrix/balanced.h"
#include "solve/matrix/bc1_blocks.h"
#include "solve/matrix/log_image.h"

namespace lumel::bench {
namespace {

/// Arrays on the device are not empty; a last pair of values may read one factor too many.
template <class T>
std::vector<T> and_one(std::vector<T> values)
{
    values.push_back({});
    return values;
}

gpu::Array<float> zero_floats(const gpu::Device& device, std::size_t count,
                              const gpu::Name& name = gpu::Name::of_line())
{
    return gpu::Array<float>(device, std::span<const float>(std::vector<float>(count)), name);
}

}  // namespace

MultiplyHierarchy::RowsOnDevice::RowsOnDevice(const gpu::Device& device, Rows rows)
    : count(std::uint32_t(rows.first.size() - 1)),
      first(device, std::span<const std::uint32_t>(rows.first)),
      segments(device, std::span<const HierarchySegment>(and_one(std::move(rows.segments)))),
      words(device, std::span<const std::uint32_t>(and_one(std::move(rows.words))))
{
}

/// A segment for the row that is being made.
void MultiplyHierarchy::add(Rows& rows, std::span<const std::uint16_t> values, std::uint32_t source,
                            bool seen)
{
    const auto word = std::uint32_t(rows.words.size());
    for (std::size_t i = 0; i < values.size(); i += 2)
        rows.words.push_back(values[i] |
                             (i + 1 < values.size() ? std::uint32_t(values[i + 1]) << 16 : 0u));
    rows.segments.push_back(
        {word, source, std::uint32_t(rows.words.size()) - word, seen ? 1u : 0u});
}

/// Rows of V^T, in the order of blocks.
MultiplyHierarchy::Rows MultiplyHierarchy::seeing_rows(const HierarchicalMatrix& matrix,
                                                       std::uint32_t width)
{
    Rows rows;
    for (std::uint32_t c = 0; c < 3; ++c)
        for (const HierarchyBlock& block : matrix.blocks[c])
            for (std::uint32_t k = 0; k < block.rank; ++k) {
                const std::size_t first = block.first + std::size_t(block.rows) * block.rank +
                                          std::size_t(k) * block.columns;
                add(rows, std::span(matrix.values[c]).subspan(first, block.columns),
                    c * width + block.column, false);
                rows.first.push_back(std::uint32_t(rows.segments.size()));
            }
    return rows;
}

MultiplyHierarchy::Rows MultiplyHierarchy::sending_rows(const HierarchicalMatrix& matrix,
                                                        std::uint32_t width)
{
    Rows rows;
    std::uint32_t before = 0;  // rows of V^T
    for (std::uint32_t c = 0; c < 3; ++c) {
        std::vector<std::vector<std::pair<const HierarchyBlock*, std::uint32_t>>> of_row(width);
        for (const HierarchyBlock& block : matrix.blocks[c]) {
            for (std::uint32_t i = 0; i < block.rows; ++i)
                of_row[block.row + i].emplace_back(&block, before);
            before += block.rank;
        }
        for (std::uint32_t row = 0; row < width; ++row) {
            for (const auto& [block, seen] : of_row[row]) {
                const std::uint32_t count = block->rank > 0 ? block->rank : block->columns;
                const std::size_t first = block->first + std::size_t(row - block->row) * count;
                add(rows, std::span(matrix.values[c]).subspan(first, count),
                    block->rank > 0 ? seen : c * width + block->column, block->rank > 0);
            }
            rows.first.push_back(std::uint32_t(rows.segments.size()));
        }
    }
    return rows;
}

MultiplyHierarchy::MultiplyHierarchy(const gpu::Device& device, const HierarchicalMatrix& matrix,
                                     [[maybe_unused]] std::uint32_t states)
    : width_(filled_up(matrix.size)),
      unit_(matrix.unit[0], matrix.unit[1], matrix.unit[2]),
      see_(device, seeing_rows(matrix, width_)),
      send_(device, sending_rows(matrix, width_)),
      in_(zero_floats(device, std::size_t(width_) * 3 + 1)),
      seen_(zero_floats(device, std::size_t(see_.count) + 1)),
      out_(device, std::size_t(width_) * 3),
      gather_(device, matrix.size, width_, matrix.order,
              sent_weights(matrix.color, matrix.root_area)),
      scatter_(device, matrix.size, width_, matrix.order, received_weights(matrix.root_area), {}),
      kernel_(device)
{
    assert(states == 1);
}

void MultiplyHierarchy::record(gpu::Commands& commands, const RowsOnDevice& rows,
                               const gpu::Array<float>& result, std::uint32_t plane,
                               const glm::vec3& scale)
{
    if (rows.count > 0)
        commands.dispatch(kernel_,
                          {.first = rows.first,
                           .segments = rows.segments,
                           .words = rows.words,
                           .light = in_,
                           .seen = &result == &seen_ ? in_ : seen_,
                           .result = result},
                          HierarchyParams{rows.count, plane, scale}, rows.count);
}

void MultiplyHierarchy::record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                               const gpu::Array<glm::vec3>& y, std::uint32_t states)
{
    gather_.record(commands, x, in_, states);
    record(commands, see_, seen_, std::max(see_.count, 1u), glm::vec3(1.0f));
    record(commands, send_, out_, width_, unit_);
    scatter_.record(commands, out_, x, y, states);
}

}  // namespace lumel::bench
