#include "picture/lit_scene.h"

#include <algorithm>
#include <cmath>

namespace lumel {

LitScene::LitScene(const Scene& scene, const Atlas& atlas, const Lumels& lumels, const Image& front,
                   const Image& back)
    : scene_(&scene),
      atlas_(&atlas),
      front_map_(&front),
      back_map_(back.values.empty() ? &front : &back),
      first_surface_(scene.instances.size(), 0),
      front_(std::size_t(lumels.width) * std::size_t(lumels.height), kNone),
      back_(front_)
{
    for (std::size_t s = atlas.surfaces.size(); s-- > 0;)
        first_surface_[atlas.surfaces[s].instance] = s;
    for (std::uint32_t i = 0; i < lumels.lumels.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        (lumel.flags & kLumelBack ? back_ : front_)[lumel.texel] = i;
    }
}

glm::vec2 LitScene::place(const RayHit& hit) const
{
    const Surface& surface = atlas_->surfaces[first_surface_[hit.instance] + hit.primitive];
    const std::uint32_t* corner = surface.indices.data() + std::size_t(hit.triangle) * 3;
    return surface.texcoord[corner[0]] * (1.0f - hit.barycentric.x - hit.barycentric.y) +
           surface.texcoord[corner[1]] * hit.barycentric.x +
           surface.texcoord[corner[2]] * hit.barycentric.y;
}

glm::vec3 LitScene::irradiance(const RayHit& hit) const
{
    const Image& map = hit.front ? *front_map_ : *back_map_;
    const glm::vec2 at = place(hit) - 0.5f;
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

std::uint32_t LitScene::lumel(const RayHit& hit) const
{
    const glm::vec2 at = place(hit);
    const int x = std::clamp(int(at.x), 0, atlas_->width - 1);
    const int y = std::clamp(int(at.y), 0, atlas_->height - 1);
    return (hit.front ? front_
                      : back_)[std::size_t(y) * std::size_t(atlas_->width) + std::size_t(x)];
}

glm::vec3 LitScene::sky(const glm::vec3& direction) const
{
    return sky_radiance(scene_->sky, direction);
}

}  // namespace lumel
