#pragma once
// Light of a solved scene at ray hits.

#include <cstdint>

#include "atlas/near/hit_lumels.h"
#include "atlas/prepare/solve_scene.h"
#include "base/core/image.h"
#include "lights/sources.h"

namespace lumel {

/// Looks up a scene's lightmap and lumels at ray hits. All arguments must outlive this.
class LitScene {
public:
    /// The maps hold the finished irradiance of each side [lx]; back: empty if equal to `front`.
    LitScene(const SolveScene& scene, const Image& front, const Image& back);

    const RayScene& rays() const { return scene_->rays; }
    const Surfaces& surfaces() const { return scene_->surfaces; }

    /// H on the side that was hit, bilinear [lx].
    glm::vec3 irradiance(const RayHit& hit) const;

    /// Radiance of the sky in a unit direction [cd/m²].
    glm::vec3 sky(const glm::vec3& direction) const;

    const LightSources& lamps() const { return lamps_; }

    /// Index of the lumel on the side that was hit; HitLumels::kNone if there is none.
    std::uint32_t lumel(const RayHit& hit) const { return lumels_.lumel(hit); }

private:
    const SolveScene* scene_;
    HitLumels lumels_;
    LightSources lamps_;
    const Image *front_map_, *back_map_;
};

}  // namespace lumel
