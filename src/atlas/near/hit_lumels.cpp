#include "atlas/near/hit_lumels.h"

#include <algorithm>

namespace lumel {

std::vector<std::size_t> first_surfaces(const Atlas& atlas, std::size_t instances)
{
    std::vector<std::size_t> first(instances, 0);
    for (std::size_t s = atlas.surfaces.size(); s-- > 0;)
        first[atlas.surfaces[s].instance] = s;
    return first;
}

HitLumels::HitLumels(const Scene& scene, const Atlas& atlas, const Lumels& lumels)
    : atlas_(&atlas),
      first_surface_(first_surfaces(atlas, scene.instances.size())),
      front_(std::size_t(lumels.width) * std::size_t(lumels.height), kNone),
      back_(front_)
{
    for (const Surface& surface : atlas.surfaces) {
        first_triangle_.push_back(corners_.size());
        for (std::size_t k = 0; k + 2 < surface.indices.size(); k += 3)
            corners_.push_back({surface.texcoord[surface.indices[k]],
                                surface.texcoord[surface.indices[k + 1]],
                                surface.texcoord[surface.indices[k + 2]]});
    }
    for (std::uint32_t i = 0; i < lumels.lumels.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        (lumel.flags & kLumelBack ? back_ : front_)[lumel.texel] = i;
    }
}

glm::vec2 HitLumels::place(const RayHit& hit) const
{
    const Corners& corner =
        corners_[first_triangle_[first_surface_[hit.instance] + hit.primitive] + hit.triangle];
    return corner.first * (1.0f - hit.barycentric.x - hit.barycentric.y) +
           corner.second * hit.barycentric.x + corner.third * hit.barycentric.y;
}

std::uint32_t HitLumels::lumel(const RayHit& hit) const
{
    const glm::vec2 at = place(hit);
    const int x = std::clamp(int(at.x), 0, atlas_->width - 1);
    const int y = std::clamp(int(at.y), 0, atlas_->height - 1);
    return (hit.front ? front_
                      : back_)[std::size_t(y) * std::size_t(atlas_->width) + std::size_t(x)];
}

}  // namespace lumel
