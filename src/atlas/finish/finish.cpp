#include "atlas/finish/finish.h"

#include <algorithm>

namespace lumel {
namespace {

/// Map of one side. `other`: the flag of lumels of the other side, kLumelBack or 0.
Image side_map(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
               std::span<const glm::vec3> values, std::uint32_t other)
{
    std::vector<std::uint8_t> sides(lumels.coverage.size(), 0);
    for (const Lumel& lumel : lumels.lumels)
        ++sides[lumel.texel];
    Lumels shown{.width = lumels.width, .height = lumels.height, .coverage = lumels.coverage};
    std::vector<glm::vec3> shown_values;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        if (sides[lumel.texel] > 1 && (lumel.flags & kLumelBack) == other)
            continue;
        shown.lumels.push_back(lumel);
        shown_values.push_back(values[i]);
    }
    return finish_map(scene, atlas, shown, shown_values);
}

}  // namespace

Image finish_map(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                 std::span<const glm::vec3> values)
{
    return finish_maps(scene, atlas, lumels, values, {}).light;
}

SideMaps finish_sides(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                      std::span<const glm::vec3> values)
{
    const bool one_side = std::none_of(lumels.lumels.begin(), lumels.lumels.end(),
                                       [](const Lumel& lumel) { return lumel.flags & kLumelBack; });
    if (one_side)
        return {finish_map(scene, atlas, lumels, values), {}};
    return {side_map(scene, atlas, lumels, values, kLumelBack),
            side_map(scene, atlas, lumels, values, 0u)};
}

FinishedMaps finish_maps(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                         std::span<const glm::vec3> light,
                         std::span<const std::vector<glm::vec3>> layers)
{
    const std::vector<std::uint32_t> shown = shown_lumels(lumels, light);
    FinishedMaps maps{to_map(lumels, shown, light), {}};
    for (const std::vector<glm::vec3>& values : layers)
        maps.layers.push_back(to_map(lumels, shown, values));
    fill_buried(maps.light, lumels, shown, maps.layers);
    dilate(maps.light);
    for (Image& layer : maps.layers)
        dilate(layer);
    match_seams(maps.light, scene, atlas, lumels, maps.layers);
    return maps;
}

}  // namespace lumel
