#include "solve/matrix/multiply_bc1.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/core/error.h"
#include "solve/matrix/log_code.shared.h"

namespace lumel {
namespace {

/// States multiplied at once; each takes kBc1Rows sums in registers.
constexpr std::uint32_t kMaxStates = 4;

constexpr float kMinLargest = 1e-37f;  // a channel without light has a logarithm too

std::uint32_t groups_of(std::uint32_t rows)
{
    return (rows + kBc1Rows - 1) / kBc1Rows;
}

gpu::Target texture_of(const gpu::Device& device, const Bc1Matrix& matrix)
{
    if (!device.can_read_blocks())
        throw Error(ErrorKind::device, device.info().name,
                    "has no BC1 textures, which this matrix is stored in; bake the scene with "
                    "--form tiles");
    const std::uint32_t width = filled_up(matrix.decoding.size);
    const std::uint32_t height = groups_of(width) * kBc1Rows;
    std::vector<std::uint32_t> blocks = matrix.blocks;
    blocks.resize(gpu::image_bytes(gpu::Pixel::bc1, width, height) / sizeof(std::uint32_t));
    gpu::Target codes(device, gpu::Pixel::bc1, width, height, 1u, 1u, "multiply_bc1.codes");
    codes.upload(blocks.data());
    return codes;
}

Bc1Params decoding_of(const LogDecoding& decoding)
{
    constexpr float log2_e = std::numbers::log2e_v<float>;
    Bc1Params params{.width = filled_up(decoding.size),
                     .log_step = decoding.offset / kLogCodes * log2_e};
    for (int c = 0; c < 3; ++c)
        params.log_factor[c] =
            std::log2(std::max(decoding.largest[c], kMinLargest)) - decoding.offset * log2_e;
    return params;
}

}  // namespace

MultiplyBc1::MultiplyBc1(const gpu::Device& device, const Bc1Matrix& matrix, std::uint32_t states)
    : device_(&device),
      width_(filled_up(matrix.decoding.size)),
      decoding_(decoding_of(matrix.decoding)),
      in_(device, std::size_t(states) * 3 * width_),
      out_(device, std::size_t(states) * 3 * width_),
      gather_(device, matrix.decoding.size, width_, matrix.decoding.order, {}),
      codes_(texture_of(device, matrix)),
      sampler_(device, gpu::Filter::nearest, gpu::Address::clamp, gpu::Address::clamp),
      scatter_(device, matrix.decoding.size, width_, matrix.decoding.order, {},
               matrix.decoding.exact)
{
}

void MultiplyBc1::record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                         const gpu::Array<glm::vec3>& y, std::uint32_t states)
{
    gather_.record(commands, x, in_, states);
    Bc1Params params = decoding_;
    while (params.first_state < states) {
        const std::uint32_t at_once = std::min(kMaxStates, states - params.first_state);
        const auto& product = products_.try_emplace(at_once, *device_, at_once).first->second;
        commands.dispatch(product, {.codes = {codes_, sampler_}, .received = in_, .sent = out_},
                          params, std::size_t(groups_of(width_)) * kBc1Lanes);
        params.first_state += at_once;
    }
    scatter_.record(commands, out_, x, y, states);
}

}  // namespace lumel
