#include "results/picture/lit_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lumel {
namespace {

/// place: [texels]
glm::vec3 bilinear(const Image& map, const glm::vec2& place)
{
    const glm::vec2 at = place - 0.5f;
    const glm::vec2 low = glm::floor(at), share = at - low;
    const auto texel = [&](float x, float y) {
        const float* value =
            map.at(std::clamp(int(x), 0, map.width - 1), std::clamp(int(y), 0, map.height - 1));
        return glm::vec3(value[0], value[1], value[2]);
    };
    return glm::mix(
        glm::mix(texel(low.x, low.y), texel(low.x + 1.0f, low.y), share.x),
        glm::mix(texel(low.x, low.y + 1.0f), texel(low.x + 1.0f, low.y + 1.0f), share.x), share.y);
}

}  // namespace

LitScene::LitScene(const SolveScene& scene, const Image& front, const Image& back)
    : scene_(&scene),
      lumels_(scene.scene, scene.atlas, scene.lumels),
      lamps_(scene.scene, scene.surfaces, scene.extent(), kLampsAlone),
      front_maps_{&front},
      back_maps_{back.values.empty() ? &front : &back},
      layer_of_lamp_(lamps_.count(), 0),
      layer_of_instance_(scene.scene.instances.size(), 0)
{
}

LitScene::LitScene(const SolveScene& scene, std::span<const Image> maps, const LampTable& lamps)
    : scene_(&scene),
      lumels_(scene.scene, scene.atlas, scene.lumels),
      lamps_(scene.scene, scene.surfaces, scene.extent(), kLampsAlone),
      layer_of_lamp_(lamps_.count(), 0),
      layer_of_instance_(scene.scene.instances.size(), 0),
      sky_layer_(lamps.of_dim_sky)
{
    for (const Image& map : maps)
        front_maps_.push_back(&map);
    back_maps_ = front_maps_;
    // The table is of all sources, this has the lamps and suns alone.
    const LightSources all(scene.scene, scene.surfaces, scene.extent());
    std::vector<std::uint32_t> layer_of_light(scene.scene.lights.size(), 0);
    for (std::size_t s = 0; s < all.count(); ++s) {
        const LightSources::SourceInfo info = all.origin(s);
        if (info.part == LightSources::Part::material)
            layer_of_instance_[info.instance] = lamps.of_source[s];
        if (info.part == LightSources::Part::light)
            layer_of_light[info.index] = lamps.of_source[s];
    }
    for (std::size_t s = 0; s < lamps_.count(); ++s)
        layer_of_lamp_[s] = layer_of_light[lamps_.origin(s).index];
}

glm::vec3 LitScene::irradiance(const RayHit& hit, std::size_t layer) const
{
    return bilinear(*(hit.front ? front_maps_ : back_maps_)[layer], lumels_.place(hit));
}

void LitScene::add_light(const RayHit& hit, const glm::vec3& luminance, const glm::vec3& diffuse,
                         const glm::vec3& weight, std::span<glm::vec3> sum) const
{
    const glm::vec2 place = lumels_.place(hit);
    const std::vector<const Image*>& maps = hit.front ? front_maps_ : back_maps_;
    for (std::size_t layer = 0; layer < maps.size(); ++layer) {
        glm::vec3 sent = diffuse * bilinear(*maps[layer], place) * std::numbers::inv_pi_v<float>;
        if (layer == layer_of_instance_[hit.instance])
            sent += luminance;
        sum[layer] += weight * sent;
    }
}

}  // namespace lumel
