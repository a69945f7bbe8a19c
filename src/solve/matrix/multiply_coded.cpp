#include "solve/matrix/multiply_coded.h"

#include "solve/matrix/half.h"

namespace lumel {
namespace {

std::span<const std::vector<std::uint32_t>> planes_of(const CodedMatrix& matrix)
{
    return std::span(matrix.words).first(matrix.code == Code::bc1 ? 1 : 3);
}

Decoding decoding_of(const CodedMatrix& matrix)
{
    return {{matrix.largest[0], matrix.largest[1], matrix.largest[2]}, matrix.offset};
}

}  // namespace

MultiplyCoded::MultiplyCoded(const gpu::Device& device, const CodedMatrix& matrix,
                             std::uint32_t states, Decoder decoder)
    : width_(filled_up(matrix.size)),
      in_(device, std::size_t(states) * 3 * width_),
      out_(device, std::size_t(states) * 3 * width_),
      gather_(device, matrix.size, width_, matrix.column_order, {}),
      product_(device, matrix.code, planes_of(matrix), matrix.size, matrix.size,
               decoding_of(matrix), decoder),
      scatter_(device, matrix.size, width_, matrix.row_order, {}, matrix.exact)
{
}

void MultiplyCoded::record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                           const gpu::Array<glm::vec3>& y, std::uint32_t states)
{
    gather_.record(commands, x, in_, states);
    product_.record(commands, in_, out_, width_, states);
    scatter_.record(commands, out_, x, y, states);
}

}  // namespace lumel
