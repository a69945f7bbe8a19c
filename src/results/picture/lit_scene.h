#pragma once
// Light of a solved scene at ray hits.

#include <cstdint>

#include "atlas/near/hit_lumels.h"
#include "atlas/packing/atlas.h"
#include "base/core/image.h"
#include "lights/lamps.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// Looks up a scene's lightmap and lumels at ray hits. All arguments must outlive this.
class LitScene {
public:
    /// The maps hold the finished irradiance of each side [lx]; back: empty if equal to `front`.
    LitScene(const Scene& scene, const Atlas& atlas, const Lumels& lumels, const Image& front,
             const Image& back);

    /// H on the side that was hit, bilinear [lx].
    glm::vec3 irradiance(const RayHit& hit) const;

    /// Radiance of the sky in a unit direction [cd/m²].
    glm::vec3 sky(const glm::vec3& direction) const;

    const Lamps& lamps() const { return lamps_; }

    /// Index of the lumel on the side that was hit; HitLumels::kNone if there is none.
    std::uint32_t lumel(const RayHit& hit) const { return lumels_.lumel(hit); }

private:
    const Scene* scene_;
    HitLumels lumels_;
    Lamps lamps_;
    const Image *front_map_, *back_map_;
};

}  // namespace lumel
