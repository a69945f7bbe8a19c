#pragma once
// Where rays leave a lumel.

#include "atlas/cells/cells.h"

namespace lumel {

/// A point just off a lumel, to look from.
struct RayOrigin {
    glm::vec3 position;   ///< [m] world, lifted
    glm::vec3 normal;     ///< unit, interpolated
    glm::vec3 geometric;  ///< unit, of the surface; rays below it meet the lumel itself
    std::uint32_t cell;   ///< of the lumel

    /// Cosine at the surface of a direction that light may come from; 0 for others.
    float cosine(const glm::vec3& direction) const
    {
        const float cosine = glm::dot(normal, direction);
        return cosine > 0.0f && glm::dot(geometric, direction) > 0.0f ? cosine : 0.0f;
    }
};

class RayOrigins {
public:
    /// What is given must outlive it. centre: all rays leave from the lumel's centre. Without cells
    /// all starts are in cell 0.
    RayOrigins(const WorldLumels& world, const Cells* cells, float ray_offset, bool centre)
        : world_(&world),
          cells_(cells),
          ray_offset_(ray_offset),
          centre_(centre)
    {
    }

    /// `at` in the unit square, evenly by area.
    RayOrigin start(std::size_t i, const glm::vec2& at) const;

private:
    const WorldLumels* world_;
    const Cells* cells_;
    float ray_offset_;  ///< [m]
    bool centre_;
};

}  // namespace lumel
