#include "bench/papers/matrix_low_rank_product.h"

#include "solve/matrix/balanced.h"
#include "solve/matrix/half.h"

namespace lumel::bench {
namespace {

using HalfWords = std::vector<std::uint32_t>;

/// Half floats at(row, column) as RowsProduct reads them.
template <class At>
HalfWords to_words(std::uint32_t rows, std::uint32_t columns, const At& at)
{
    const std::size_t width = filled_up(columns);
    HalfWords words(filled_up(rows) * width / 2);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t place = row * width + column;
            words[place / 2] |= std::uint32_t(at(row, column)) << (16 * (place % 2));
        }
    return words;
}

/// What lies beyond the rank in a plane stays 0.
gpu::Array<float> zeros(const gpu::Device& device, std::size_t count,
                        const gpu::Name& name = gpu::Name::of_line())
{
    return gpu::Array<float>(device, std::span<const float>(std::vector<float>(count)), name);
}

RowsProduct see(const gpu::Device& device, const LowRankMatrix& matrix)
{
    const HalfWords words = to_words(matrix.rank, matrix.size, [&](std::size_t k, std::size_t i) {
        return matrix.basis[k * matrix.size + i];
    });
    return {device,      Code::float16, std::span(&words, 1),
            matrix.rank, matrix.size,   {glm::vec3(kLargestHalf)}};
}

RowsProduct send(const gpu::Device& device, const LowRankMatrix& matrix)
{
    const HalfWords words = to_words(matrix.size, matrix.rank, [&](std::size_t i, std::size_t k) {
        return matrix.basis[k * matrix.size + i];
    });
    return {device,      Code::float16, std::span(&words, 1),
            matrix.size, matrix.rank,   {glm::vec3(kLargestHalf)}};
}

RowsProduct core(const gpu::Device& device, const LowRankMatrix& matrix)
{
    std::array<HalfWords, 3> words;
    for (std::size_t c = 0; c < 3; ++c)
        words[c] = to_words(matrix.rank, matrix.rank, [&](std::size_t k, std::size_t l) {
            return matrix.core[c][k * matrix.rank + l];
        });
    const glm::vec3 units(matrix.unit[0], matrix.unit[1], matrix.unit[2]);
    return {device, Code::float16, words, matrix.rank, matrix.rank, {units * kLargestHalf}};
}

}  // namespace

MultiplyLowRank::MultiplyLowRank(const gpu::Device& device, const LowRankMatrix& matrix,
                                 std::uint32_t states)
    : width_(filled_up(matrix.size)),
      rank_width_(filled_up(matrix.rank)),
      in_(device, std::size_t(states) * 3 * width_),
      seen_(zeros(device, std::size_t(states) * 3 * rank_width_)),
      sent_(zeros(device, std::size_t(states) * 3 * rank_width_)),
      out_(device, std::size_t(states) * 3 * width_),
      gather_(device, matrix.size, width_, {}, sent_weights(matrix.color, matrix.root_area)),
      see_(see(device, matrix)),
      core_(core(device, matrix)),
      send_(send(device, matrix)),
      scatter_(device, matrix.size, width_, {}, received_weights(matrix.root_area), {})
{
}

void MultiplyLowRank::record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                             const gpu::Array<glm::vec3>& y, std::uint32_t states)
{
    gather_.record(commands, x, in_, states);
    see_.record(commands, in_, seen_, rank_width_, states);
    core_.record(commands, seen_, sent_, rank_width_, states);
    send_.record(commands, sent_, out_, width_, states);
    scatter_.record(commands, out_, x, y, states);
}

}  // namespace lumel::bench
