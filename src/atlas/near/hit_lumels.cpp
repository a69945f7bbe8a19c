#include "atlas/near/hit_lumels.h"

#include <algorithm>

namespace lumel {

HitLumels::HitLumels(const Scene& scene, const Atlas& atlas, const Lumels& lumels)
    : atlas_(&atlas),
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

glm::vec2 HitLumels::place(const RayHit& hit) const
{
    const Surface& surface = atlas_->surfaces[first_surface_[hit.instance] + hit.primitive];
    const std::uint32_t* corner = surface.indices.data() + std::size_t(hit.triangle) * 3;
    return surface.texcoord[corner[0]] * (1.0f - hit.barycentric.x - hit.barycentric.y) +
           surface.texcoord[corner[1]] * hit.barycentric.x +
           surface.texcoord[corner[2]] * hit.barycentric.y;
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
