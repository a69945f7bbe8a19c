#include "bench/papers/matrix_codes_product.h"

namespace lumel::bench {
namespace {

std::span<const std::vector<std::uint32_t>> planes_of(const CodedMatrix& matrix)
{
    return std::span(matrix.words).first(is_bc1(matrix.code) ? 1 : 3);
}

Decoding decoding_of(const CodedMatrix& matrix)
{
    const std::array<float, 3>& largest = matrix.decoding.largest;
    return {{largest[0], largest[1], largest[2]}, matrix.decoding.offset};
}

}  // namespace

MultiplyCoded::MultiplyCoded(const gpu::Device& device, const CodedMatrix& matrix,
                             std::uint32_t states)
    : width_(filled_up(matrix.decoding.size)),
      in_(device, std::size_t(states) * 3 * width_),
      out_(device, std::size_t(states) * 3 * width_),
      gather_(device, matrix.decoding.size, width_, matrix.decoding.order, {}),
      product_(device, matrix.code, planes_of(matrix), matrix.decoding.size, matrix.decoding.size,
               decoding_of(matrix)),
      scatter_(device, matrix.decoding.size, width_, matrix.decoding.order, {},
               matrix.decoding.exact)
{
}

void MultiplyCoded::record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                           const gpu::Array<glm::vec3>& y, std::uint32_t states)
{
    gather_.record(commands, x, in_, states);
    product_.record(commands, in_, out_, width_, states);
    scatter_.record(commands, out_, x, y, states);
}

}  // namespace lumel::bench
