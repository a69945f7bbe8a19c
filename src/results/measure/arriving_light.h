#pragma once
// What brings light to points of a solved scene: rays that meet something, and sources that rays
// look for.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/near/hit_lumels.h"
#include "lights/ray_allocation.h"
#include "rays/cast/ray_scene.h"
#include "rays/paths/surfaces.h"

namespace lumel {

/// Safe to use from many threads at once.
class ArrivingLight {
public:
    /// irradiance [N] [lx] of the lumels, as solved, taken as diffuse. All but irradiance must
    /// outlive this, unmoved.
    ArrivingLight(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                  const Lumels& lumels, std::span<const glm::vec3> irradiance);

    /// Of all sources; see lumel::allocate_rays.
    RayAllocation allocate_rays(const glm::vec3& position, std::uint32_t rays) const
    {
        return lumel::allocate_rays(sources_, position, rays);
    }

    /// π L along a ray, but for what sources send. `backs` counts rays that tell of the inside of
    /// something: that meet the back of a single-sided surface, or one of a double-sided surface
    /// that no light reaches.
    glm::vec3 met_along(const glm::vec3& position, const glm::vec3& direction, std::uint32_t seed,
                        std::uint32_t& backs) const;

    /// The part of a sample's light that gets through; no ray is cast for none.
    glm::vec3 transmittance(const RayOrigin& start, const SourceSample& sample,
                            std::uint32_t seed) const;

    const LightSources& sources() const { return sources_; }
    float ray_offset() const { return rays_.ray_offset(); }

private:
    const RayScene& rays_;
    Surfaces surfaces_;
    LightSources sources_;
    HitLumels hits_;
    std::vector<glm::vec3> reflected_;  ///< [N] ρ H [lm/m²], 0 of buried lumels
    std::vector<char> dark_;            ///< [N] 1: of a back that no light reaches
};

}  // namespace lumel
