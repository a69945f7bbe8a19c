#pragma once
// Ray origins on lumels.

#include "atlas/cells/cells.h"

namespace lumel {

/// A ray origin just above a lumel.
struct RayOrigin {
    glm::vec3 position;   ///< [m] world, with the ray offset
    glm::vec3 normal;     ///< unit, interpolated
    glm::vec3 geometric;  ///< unit, of the surface; rays below it hit the lumel itself
    std::uint32_t cell;   ///< cell of the lumel

    /// Cosine at the surface for directions of incident light; 0 for others.
    float cosine(const glm::vec3& direction) const
    {
        const float cosine = glm::dot(normal, direction);
        return cosine > 0.0f && glm::dot(geometric, direction) > 0.0f ? cosine : 0.0f;
    }
};

/// An origin at a point of a surface without cells.
inline RayOrigin origin_at(const glm::vec3& position, const glm::vec3& normal)
{
    return {.position = position, .normal = normal, .geometric = normal, .cell = 0};
}

/// Seeds a lumel's random numbers by its place in an atlas of that width: its index changes when
/// objects are added or removed.
std::uint32_t lumel_key(const Lumel& lumel, std::uint32_t width);

class RayOrigins {
public:
    /// Pointers must outlive this. centre: all rays start at the lumel's centre. Without cells, all
    /// origins are in cell 0.
    RayOrigins(const WorldLumels& world, const Cells* cells, bool centre)
        : world_(&world),
          cells_(cells),
          centre_(centre)
    {
    }

    /// at: uniform sample in the unit square; the origin is uniform by area.
    RayOrigin start(std::size_t i, const glm::vec2& at) const;

private:
    const WorldLumels* world_;
    const Cells* cells_;
    bool centre_;
};

}  // namespace lumel
