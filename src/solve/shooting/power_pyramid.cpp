#include "solve/shooting/power_pyramid.h"

namespace lumel {
namespace {

PyramidLayout make_layout(std::size_t leaves)
{
    PyramidLayout layout{};
    std::uint32_t count = std::uint32_t(leaves), first = 0;
    for (;;) {
        layout.first[layout.levels] = first;
        layout.count[layout.levels] = count;
        ++layout.levels;
        if (count <= 1)
            return layout;
        first += count;
        count = (count + kPyramidFanout - 1) / kPyramidFanout;
    }
}

std::size_t node_count(const PyramidLayout& layout)
{
    return layout.first[layout.levels - 1] + layout.count[layout.levels - 1];
}

}  // namespace

std::uint64_t PowerPyramid::device_bytes(std::size_t lumel_count)
{
    return (node_count(make_layout(lumel_count)) + 1) * sizeof(float);
}

PowerPyramid::PowerPyramid(const gpu::Device& device, std::size_t lumel_count)
    : layout_(make_layout(lumel_count)),
      array_(device, node_count(layout_)),
      power_(device, 1),
      leaves_(device),
      sum_(device),
      count_(lumel_count)
{
}

void PowerPyramid::sum_levels(gpu::Commands& commands)
{
    for (std::uint32_t level = 1; level < layout_.levels; ++level)
        commands.dispatch(sum_, {.pyramid = array_},
                          PyramidSumParams{layout_.first[level - 1], layout_.count[level - 1],
                                           layout_.first[level], layout_.count[level]},
                          layout_.count[level]);
}

void PowerPyramid::build(gpu::Commands& commands, const gpu::Array<glm::vec3>& source,
                         const gpu::Array<glm::vec4>& surface, float by_area, float area_sum)
{
    const auto leaves = [&](float share) {
        commands.dispatch(
            leaves_, {.source = source, .surface = surface, .power = power_, .pyramid = array_},
            PyramidLeafParams{std::uint32_t(count_), share, area_sum}, count_);
        sum_levels(commands);
    };
    // Power first: the defensive weights are relative to it.
    leaves(0.0f);
    commands.copy_part(array_.buffer(), layout_.first[layout_.levels - 1] * sizeof(float),
                       power_.buffer(), 0, sizeof(float));
    if (by_area > 0.0f && area_sum > 0.0f)
        leaves(by_area);
}

}  // namespace lumel
