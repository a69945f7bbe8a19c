#include "matrix/rows_product.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "matrix/block_codes.h"
#include "matrix/half.h"
#include "matrix/log_code.shared.h"
#include "matrix/rows_product.shared.h"

namespace lumel {
namespace {

constexpr std::uint32_t kFloatSpirv[] = {
#include "matrix/rows_product.float.comp.inc"
};
constexpr std::uint32_t kHalfSpirv[] = {
#include "matrix/rows_product.half.comp.inc"
};
constexpr std::uint32_t kLog8Spirv[] = {
#include "matrix/rows_product.log8.comp.inc"
};
constexpr std::uint32_t kBc4Spirv[] = {
#include "matrix/rows_product.bc4.comp.inc"
};
constexpr std::uint32_t kBc1Spirv[] = {
#include "matrix/rows_product.bc1.comp.inc"
};
constexpr std::uint32_t kTextureSpirv[] = {
#include "matrix/rows_product.texture.comp.inc"
};

/// Vectors that a kernel takes at once: each has a sum for every row of a group in registers.
constexpr std::uint32_t kMostVectors = 4, kMostColorVectors = 1;

/// An array is not larger, so that its staging copy is not either.
constexpr std::uint64_t kMostPartBytes = std::uint64_t(256) << 20;

constexpr std::uint32_t kBlockRows = kBlockSide;  // all codes lie in memory by four rows

constexpr float kLeastLargest = 1e-37f;  // a channel without light has a logarithm too

/// Words of four rows.
std::size_t block_row_words(Code code, std::uint32_t quads)
{
    return std::size_t(quads) * kBlockTexels * bits_of(code) / 32;
}

gpu::Spirv spirv_of(Code code, bool texture)
{
    switch (code) {
    case Code::float32:
        return kFloatSpirv;
    case Code::float16:
        return kHalfSpirv;
    case Code::log8:
        return kLog8Spirv;
    case Code::bc4:
        return kBc4Spirv;
    case Code::bc1:
        return texture ? gpu::Spirv(kTextureSpirv) : gpu::Spirv(kBc1Spirv);
    }
    return {};
}

std::uint32_t whole_groups(std::uint32_t rows)
{
    return (rows + kProductRows - 1) / kProductRows * kProductRows;
}

/// Software reads blocks faster itself than through its sampler.
bool in_texture(const gpu::Device& device, Decoder decoder)
{
    return decoder == Decoder::automatic ? device.can_read_blocks() && device.info().type != "cpu"
                                         : decoder == Decoder::hardware;
}

}  // namespace

RowsProduct::RowsProduct(const gpu::Device& device, Code code,
                         std::span<const std::vector<std::uint32_t>> words, std::uint32_t rows,
                         std::uint32_t columns, const Decoding& decoding, Decoder decoder)
    : device_(&device),
      code_(code),
      one_for_all_(code != Code::bc1 && words.size() == 1),
      rows_(rows),
      plane_rows_(whole_groups(rows)),
      quads_(filled_up(columns) / 4),
      decoding_(decoding),
      sampler_(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp)
{
    if (code == Code::bc1 && in_texture(device, decoder))
        upload_texture(words[0]);
    else
        upload(words);
}

void RowsProduct::upload(std::span<const std::vector<std::uint32_t>> words)
{
    const std::size_t per_block_row = block_row_words(code_, quads_);
    const std::uint64_t group_bytes =
        per_block_row * sizeof(std::uint32_t) * (kProductRows / kBlockRows);
    const std::uint64_t most = std::min(device_->max_array_bytes(), kMostPartBytes);
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

void RowsProduct::upload_texture(const std::vector<std::uint32_t>& words)
{
    std::vector<std::uint32_t> image = words;
    image.resize(block_row_words(code_, quads_) * (plane_rows_ / kBlockRows));
    bytes_ = image.size() * sizeof(std::uint32_t);
    texture_.emplace(*device_, gpu::Pixel::bc1, quads_ * 4, plane_rows_, 1u, 1u,
                     "rows_product.codes");
    texture_->upload(image.data());
}

gpu::Kernel& RowsProduct::kernel(std::uint32_t vectors)
{
    const auto found = kernels_.find(vectors);
    if (found != kernels_.end())
        return found->second;
    const std::array slots = {texture_ ? gpu::Slot::texture : gpu::Slot::array, gpu::Slot::array,
                              gpu::Slot::array};
    return kernels_
        .try_emplace(vectors, *device_, "rows_product", spirv_of(code_, texture_.has_value()),
                     slots, std::uint32_t(sizeof(ProductParams)), kProductLanes, vectors)
        .first->second;
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
            std::log2(std::max(decoding_.largest[c], kLeastLargest)) - decoding_.offset * log2_e;
    const std::uint32_t vectors = one_for_all_ ? 3 * states : states;
    const std::uint32_t most = code_ == Code::bc1 ? kMostColorVectors : kMostVectors;
    for (std::uint32_t first = 0; first < vectors; first += most) {
        const std::uint32_t at_once = std::min(most, vectors - first);
        params.first_vector = first * params.vector_step;
        const auto groups = [](std::uint32_t rows) {
            return std::size_t(rows / kProductRows) * kProductLanes;
        };
        if (texture_)
            commands.dispatch(kernel(at_once), {{*texture_, sampler_}, x, y}, params,
                              groups(plane_rows_));
        for (const Part& part : parts_) {
            params.first_row = part.first_row;
            commands.dispatch(kernel(at_once), {part.words, x, y}, params, groups(part.rows));
        }
    }
}

}  // namespace lumel
