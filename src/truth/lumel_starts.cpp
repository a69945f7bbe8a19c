#include "truth/lumel_starts.h"

#include <algorithm>

#include "atlas/lumels/sampling.h"

namespace lumel {

LumelStarts::LumelStarts(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                         SampleRule rule)
    : lumels_(lumels),
      rule_(rule),
      ray_offset_(rays.ray_offset())
{
    for (const Instance& instance : scene.instances) {
        transforms_.push_back(instance.transform);
        normal_transforms_.push_back(glm::transpose(glm::inverse(glm::mat3(instance.transform))));
    }
}

PathVertex LumelStarts::start(std::size_t i, const glm::vec2& at) const
{
    const Lumel& lumel = lumels_.lumels[i];
    glm::vec3 position = lumel.position;
    glm::vec3 normal = lumel.normal;
    glm::vec3 geometric = lumel.normal;
    if (rule_ == SampleRule::area) {
        const LumelPoint point = point_on(lumels_, lumel, at.x, at.y);
        position = point.position;
        normal = point.normal;
        std::uint32_t piece = lumel.first_piece;
        while (piece + 1 < lumel.first_piece + lumel.piece_count &&
               at.x >= lumels_.pieces[piece].share)
            ++piece;
        geometric = glm::cross(lumels_.pieces[piece].edge_u, lumels_.pieces[piece].edge_v);
    }
    const glm::mat3& normal_transform = normal_transforms_[lumel.instance];
    geometric = glm::normalize(normal_transform * geometric);
    // Also shifts towards the centre, so that no origin is behind a wall that touches the lumel.
    const glm::mat4& transform = transforms_[lumel.instance];
    const glm::vec3 world(transform * glm::vec4(position, 1.0f));
    const glm::vec3 centre(transform * glm::vec4(lumel.position, 1.0f)), inward = centre - world;
    const float distance = glm::length(inward);
    const float ray_offset =
        lumels_.edge.empty()
            ? ray_offset_
            : ray_offset_for(std::max(largest_coordinate(centre), lumels_.edge[i]));
    glm::vec3 lifted = world + ray_offset * geometric;
    if (distance > 0.0f)
        lifted += inward * (std::min(ray_offset, 0.5f * distance) / distance);
    return {lifted, geometric, Brdf(glm::normalize(normal_transform * normal))};
}

}  // namespace lumel
