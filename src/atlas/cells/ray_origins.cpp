#include "atlas/cells/ray_origins.h"

#include "rays/paths/samples.h"

namespace lumel {

std::uint32_t lumel_key(const Lumel& lumel, std::uint32_t width)
{
    const std::uint32_t x = lumel.texel % width, y = lumel.texel / width;
    return PathSamples::hash(PathSamples::hash(x, y), lumel.flags & kLumelBack ? 1u : 0u);
}

RayOrigin RayOrigins::start(std::size_t i, const glm::vec2& at) const
{
    const WorldLumel& lumel = (*world_)[i];
    const std::span<const Piece> pieces = world_->pieces(lumel);
    std::size_t index = 0;
    while (index + 1 < pieces.size() && at.x >= pieces[index].share)
        ++index;
    const LumelPoint point =
        centre_ ? LumelPoint{lumel.centre, lumel.normal} : world_->point_on(i, at);
    glm::vec3 geometric = glm::normalize(glm::cross(pieces[index].edge_u, pieces[index].edge_v));
    if (glm::dot(geometric, point.normal) < 0.0f)
        geometric = -geometric;  // the instance mirrors

    // Also shifted towards the centre, so that no origin is behind a wall that touches the lumel.
    const float ray_offset = ray_offset_for(lumel.reach);
    RayOrigin start{point.position + ray_offset * geometric, point.normal, geometric,
                    cells_ ? cells_->cell(i, point.position) : 0u};
    const glm::vec3 inward = lumel.centre - point.position;
    const float distance = glm::length(inward);
    if (distance > 0.0f)
        start.position += inward * (std::min(ray_offset, 0.5f * distance) / distance);
    return start;
}

}  // namespace lumel
