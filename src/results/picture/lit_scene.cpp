#include "results/picture/lit_scene.h"

#include <algorithm>
#include <cmath>

namespace lumel {

LitScene::LitScene(const SolveScene& scene, const Image& front, const Image& back)
    : scene_(&scene),
      lumels_(scene.scene, scene.atlas, scene.lumels),
      lamps_(scene.scene, scene.surfaces, scene.extent(), kLampsAlone),
      front_map_(&front),
      back_map_(back.values.empty() ? &front : &back)
{
}

glm::vec3 LitScene::irradiance(const RayHit& hit) const
{
    const Image& map = hit.front ? *front_map_ : *back_map_;
    const glm::vec2 at = lumels_.place(hit) - 0.5f;
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

glm::vec3 LitScene::sky(const glm::vec3& direction) const
{
    return sky_radiance(scene_->scene.sky, direction);
}

}  // namespace lumel
