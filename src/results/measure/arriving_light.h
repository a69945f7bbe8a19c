#pragma once
// Incoming light at points of a solved scene, along rays and from sampled sources.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/near/hit_lumels.h"
#include "lights/ray_allocation.h"
#include "rays/cast/ray_scene.h"
#include "rays/paths/surfaces.h"

namespace lumel {

/// Light along a ray, without that of sources.
struct MetLight {
    glm::vec3 light{0.0f};                   ///< π L
    std::uint32_t lumel = HitLumels::kNone;  ///< that reflects it
    bool is_sky = false;                     ///< of LightSources::dim_sky()
    glm::vec3 tint{1.0f};                    ///< of the glass that it passed
};

/// Thread-safe.
class ArrivingLight {
public:
    /// irradiance: [N] solution of the lumels [lx], treated as diffuse. All other arguments must
    /// outlive this, unmoved.
    ArrivingLight(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                  const Lumels& lumels, std::span<const glm::vec3> irradiance);

    /// Rays to all sources; see lumel::allocate_rays.
    RayAllocation allocate_rays(const Receiver& receiver, std::uint32_t rays) const
    {
        return lumel::allocate_rays(sources_, receiver, rays);
    }

    /// Light along a ray. backs: counts rays from the inside of objects:
    /// those that hit the back of a single-sided surface, an unlit or inner side of a double-sided
    /// one, or a buried lumel.
    MetLight met_along(const glm::vec3& position, const glm::vec3& direction, std::uint32_t seed,
                       std::uint32_t& backs) const;

    /// Transmittance to a sample; traces no ray if its light is 0.
    glm::vec3 transmittance(const RayOrigin& start, const SourceSample& sample,
                            std::uint32_t seed) const;

    const LightSources& sources() const { return sources_; }
    /// As RayScene::ray_offset().
    float ray_offset(const glm::vec3& position, const glm::vec3& normal) const
    {
        return rays_.ray_offset(position, normal);
    }

private:
    bool is_inner(const RayHit& hit) const;

    const RayScene& rays_;
    Surfaces surfaces_;
    LightSources sources_;
    HitLumels hits_;
    std::vector<glm::vec3> reflected_;  ///< [N] ρ H [lm/m²], 0 of buried lumels
    std::vector<char> dark_;            ///< [N] 1: buried, or of an unlit back
    const Atlas& atlas_;
    std::vector<std::array<bool, 2>> inner_;  ///< [charts] as Atlas::inner
    std::vector<std::size_t> first_surface_;  ///< [instances]
};

}  // namespace lumel
