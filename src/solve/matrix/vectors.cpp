#include "solve/matrix/vectors.h"

#include <numeric>

#include "solve/matrix/vectors.shared.h"

namespace lumel {
namespace {

std::vector<std::uint32_t> as_is(std::uint32_t count)
{
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    return order;
}

std::vector<std::uint32_t> or_as_is(std::span<const std::uint32_t> order, std::uint32_t count)
{
    return order.empty() ? as_is(count) : std::vector<std::uint32_t>(order.begin(), order.end());
}

template <class T>
std::vector<T> or_ones(std::span<const T> weight, std::uint32_t count)
{
    return weight.empty() ? std::vector<T>(count, T(1.0f))
                          : std::vector<T>(weight.begin(), weight.end());
}

std::vector<std::uint32_t> inverse(std::span<const std::uint32_t> order, std::uint32_t count)
{
    std::vector<std::uint32_t> place = as_is(count);
    for (std::uint32_t i = 0; i < order.size(); ++i)
        place[order[i]] = i;
    return place;
}

/// Two to a word.
std::vector<std::uint32_t> all_columns(const SparsePart& exact)
{
    const std::size_t entries = exact.column[0].size();
    std::vector<std::uint32_t> words((3 * entries + 1) / 2);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < entries; ++k) {
            const std::size_t at = c * entries + k;
            words[at / 2] |= std::uint32_t(exact.column[c][k]) << (16 * (at % 2));
        }
    return words;
}

std::vector<float> all_values(const SparsePart& exact)
{
    std::vector<float> values;
    for (const std::vector<float>& channel : exact.value)
        values.insert(values.end(), channel.begin(), channel.end());
    return values;
}

template <class T>
gpu::Array<T> on_device(const gpu::Device& device, const std::vector<T>& values,
                        const gpu::Name& name = gpu::Name::of_line())
{
    return gpu::Array<T>(device, std::span<const T>(values), name);
}

}  // namespace

Gather::Gather(const gpu::Device& device, std::uint32_t count, std::uint32_t width,
               std::span<const std::uint32_t> order, std::span<const glm::vec3> weight)
    : count_(count),
      width_(width),
      order_(on_device(device, or_as_is(order, count))),
      weight_(on_device(device, or_ones(weight, count))),
      kernel_(device)
{
}

void Gather::record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                    const gpu::Array<float>& planes, std::uint32_t states) const
{
    commands.dispatch(kernel_, {.order = order_, .weight = weight_, .colors = x, .planes = planes},
                      PatchGatherParams{count_, width_, states}, std::size_t(states) * width_);
}

Scatter::Scatter(const gpu::Device& device, std::uint32_t count, std::uint32_t width,
                 std::span<const std::uint32_t> order, std::span<const float> weight,
                 const SparsePart& exact)
    : count_(count),
      width_(width),
      per_row_(exact.per_row),
      place_(on_device(device, inverse(order, count))),
      weight_(on_device(device, or_ones(weight, count))),
      columns_(on_device(device, all_columns(exact))),
      values_(on_device(device, all_values(exact))),
      kernel_(device)
{
}

void Scatter::record(gpu::Commands& commands, const gpu::Array<float>& planes,
                     const gpu::Array<glm::vec3>& x, const gpu::Array<glm::vec3>& y,
                     std::uint32_t states) const
{
    commands.dispatch(kernel_,
                      {.place = place_,
                       .weight = weight_,
                       .planes = planes,
                       .columns = columns_,
                       .values = values_,
                       .source = x,
                       .result = y},
                      ScatterParams{count_, width_, states, per_row_},
                      std::size_t(states) * count_ * kScatterLanes);
}

}  // namespace lumel
