#include "bench/papers/matrix_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/papers/matrix_rows.shared.h"
#include "solve/matrix/half.h"
#include "solve/matrix/log_code.shared.h"

namespace lumel::bench {
namespace {

/// Vectors that a kernel takes at once: each has a sum for every row of a group in registers.
constexpr std::uint32_t kMaxVectors = 4, kMaxColorVectors = 1;

/// An array is not larger, so that its staging copy is not either.
constexpr std::uint64_t kMaxPartBytes = std::uint64_t(256) << 20;

constexpr std::uint32_t kBlockRows = kBlockSide;  // all codes lie in memory by four rows

constexpr float kMinLargest = 1e-37f;  // a channel without light has a logarithm too

/// Words of four rows.
std::size_t block_row_words(Code code, std::uint32_t quads)
{
    return std::size_t(quads) * kBlockTexels * bits_of(code) / 32;
}

std::uint32_t whole_groups(std::uint32_t rows)
{
    return (rows + kProductRows - 1) / kProductRows * kProductRows;
}

std::size_t lanes_for(std::uint32_t rows)
{
    return std::size_t(rows / kProductRows) * kProductLanes;
}

}  // namespace

RowsProduct::RowsProduct(const gpu::Device& device, Code code,
                         std::span<const std::vector<std::uint32_t>> words, std::uint32_t rows,
                         std::uint32_t columns, const Decoding& decoding)
    : device_(&device),
      code_(code),
      one_for_all_(!is_bc1(code) && words.size() == 1),
      rows_(rows),
      plane_rows_(whole_groups(rows)),
      quads_(filled_up(columns) / 4),
      decoding_(decoding)
{
    upload(words);
}

void RowsProduct::upload(std::span<const std::vector<std::uint32_t>> words)
{
    const std::size_t per_block_row = block_row_words(code_, quads_);
    const std::uint64_t group_bytes =
        per_block_row * sizeof(std::uint32_t) * (kProductRows / kBlockRows);
    const std::uint64_t most = std::min(device_->max_array_bytes(), kMaxPartBytes);
    const std::uint32_t all_rows = plane_rows_ * std::uint32_t(words.size());
    const auto part_rows =
        std::uint32_t(std::max<std::uint64_t>(most / std::max<std::uint64_t>(group_bytes, 1), 1)) *
        kProductRows;
    for (std::uint32_t first = 0; first < all_rows; first += part_rows) {
        const std::uint32_t rows = std::min(part_rows, all_rows - first);
        std::vector<std::uint32_t> part(per_block_row * (rows / kBlockRows));
        for (std::uint32_t row = 0; row < rows; row += kBlockRows) {
            const std::vector<std::uint32_t>& plane = words[(first + row) / plane_rows_];
            const std::size_t from = (first + row) % plane_rows_ / kBlockRows * per_block_row;
            if (from < plane.size())
                std::copy_n(plane.begin() + std::ptrdiff_t(from), per_block_row,
                            part.begin() + std::ptrdiff_t(row / kBlockRows * per_block_row));
        }
        bytes_ += part.size() * sizeof(std::uint32_t);
        parts_.push_back(
            {first, rows,
             gpu::Array<std::uint32_t>(*device_, std::span<const std::uint32_t>(part))});
    }
}

RowsProduct::ProductKernel RowsProduct::make_kernel(std::uint32_t vectors) const
{
    switch (code_) {
    case Code::float32:
        return gpu::Kernel<shaders::MatrixRowsFloat>(*device_, vectors);
    case Code::float16:
        return gpu::Kernel<shaders::MatrixRowsHalf>(*device_, vectors);
    case Code::log8:
        return gpu::Kernel<shaders::MatrixRowsLog8>(*device_, vectors);
    case Code::bc4:
        return gpu::Kernel<shaders::MatrixRowsBc4>(*device_, vectors);
    case Code::bc1:
    case Code::bc1_of_codes:
        break;
    }
    return gpu::Kernel<shaders::MatrixRowsBc1>(*device_, vectors);
}

const RowsProduct::ProductKernel& RowsProduct::kernel(std::uint32_t vectors)
{
    const auto found = kernels_.find(vectors);
    if (found != kernels_.end())
        return found->second;
    return kernels_.emplace(vectors, make_kernel(vectors)).first->second;
}

template <class Shader>
void RowsProduct::record_all(gpu::Commands& commands, const gpu::Kernel<Shader>& kernel,
                             const gpu::Array<float>& x, const gpu::Array<float>& y,
                             ProductParams params)
{
    for (const Part& part : parts_) {
        params.first_row = part.first_row;
        commands.dispatch(
            kernel, {.vectors = gpu::packed(x), .result = y, .matrix = gpu::packed(part.words)},
            params, lanes_for(part.rows));
    }
}

void RowsProduct::record(gpu::Commands& commands, const gpu::Array<float>& x,
                         const gpu::Array<float>& y, std::uint32_t y_width, std::uint32_t states)
{
    constexpr float log2_e = std::numbers::log2e_v<float>;
    ProductParams params{.quads = quads_,
                         .plane_rows = plane_rows_,
                         .vector_step = one_for_all_ ? 1u : 3u,
                         .plane_step = one_for_all_ ? 0u : 1u,
                         .in_quads = quads_,
                         .out_width = y_width,
                         .count = rows_,
                         .factor = decoding_.largest / kLargestHalf,
                         .log_step = decoding_.offset / kLogCodes * log2_e};
    for (int c = 0; c < 3; ++c)
        params.log_factor[c] =
            std::log2(std::max(decoding_.largest[c], kMinLargest)) - decoding_.offset * log2_e;
    const std::uint32_t vectors = one_for_all_ ? 3 * states : states;
    const std::uint32_t most = is_bc1(code_) ? kMaxColorVectors : kMaxVectors;
    for (std::uint32_t first = 0; first < vectors; first += most) {
        const std::uint32_t at_once = std::min(most, vectors - first);
        params.first_vector = first * params.vector_step;
        std::visit([&](const auto& product) { record_all(commands, product, x, y, params); },
                   kernel(at_once));
    }
}

}  // namespace lumel::bench
