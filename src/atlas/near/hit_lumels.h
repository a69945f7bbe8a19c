#pragma once
// Which lumel a ray has hit.

#include <cstdint>
#include <vector>

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

class HitLumels {
public:
    /// The atlas must outlive this.
    HitLumels(const Scene& scene, const Atlas& atlas, const Lumels& lumels);

    /// Where in the atlas a ray hit [texels].
    glm::vec2 place(const RayHit& hit) const;

    static constexpr std::uint32_t kNone = ~0u;
    /// Index of the lumel, on the side that was hit; kNone where there is none.
    std::uint32_t lumel(const RayHit& hit) const;

private:
    const Atlas* atlas_;
    std::vector<std::size_t> first_surface_;   ///< [instances]
    std::vector<std::uint32_t> front_, back_;  ///< [height][width] lumel of each texel
};

}  // namespace lumel
