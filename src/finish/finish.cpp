#include "finish/finish.h"

namespace lumel {
namespace {

/// One value per texel, of the lumel that it shows.
Image layer_map(const std::vector<std::uint32_t>& shown, const Image& light,
                const std::vector<glm::vec3>& values)
{
    Image map = light;  // for its alpha
    for (std::size_t texel = 0; texel < shown.size(); ++texel)
        for (int c = 0; c < 3 && shown[texel] != kNoLumel; ++c)
            map.values[texel * 4 + std::size_t(c)] = values[shown[texel]][c];
    return map;
}

}  // namespace

Image finish_map(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                 std::span<const glm::vec3> values)
{
    return finish_maps(scene, atlas, lumels, values, {}).light;
}

FinishedMaps finish_maps(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                         std::span<const glm::vec3> light,
                         std::span<const std::vector<glm::vec3>> layers)
{
    FinishedMaps maps{to_map(lumels, light), {}};
    if (!layers.empty()) {
        const std::vector<std::uint32_t> shown = shown_lumels(lumels, light);
        for (const std::vector<glm::vec3>& values : layers)
            maps.layers.push_back(layer_map(shown, maps.light, values));
    }
    fill_buried(maps.light, lumels, maps.layers);
    dilate(maps.light);
    for (Image& layer : maps.layers)
        dilate(layer);
    match_seams(maps.light, scene, atlas, lumels, maps.layers);
    return maps;
}

}  // namespace lumel
