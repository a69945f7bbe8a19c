#pragma once
// Lumels at ray hits, without a search of neighbours.

#include <cstdint>
#include <vector>

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// [instances] Index of each instance's first surface, 0 if it has none.
std::vector<std::size_t> first_surfaces(const Atlas& atlas, std::size_t instances);

class HitLumels {
public:
    /// The atlas must outlive this.
    HitLumels(const Scene& scene, const Atlas& atlas, const Lumels& lumels);

    /// Atlas position of a hit [texels].
    glm::vec2 place(const RayHit& hit) const;

    static constexpr std::uint32_t kNone = ~0u;
    /// Index of the lumel on the side that was hit, or kNone.
    std::uint32_t lumel(const RayHit& hit) const;

private:
    /// Atlas positions of a triangle's corners [texels], together in memory.
    struct Corners {
        glm::vec2 first, second, third;
    };

    const Atlas* atlas_;
    std::vector<std::size_t> first_surface_;   ///< [instances]
    std::vector<std::size_t> first_triangle_;  ///< [surfaces] into corners_
    std::vector<Corners> corners_;             ///< [triangles of all surfaces]
    std::vector<std::uint32_t> front_, back_;  ///< [height][width] lumel of each texel
};

}  // namespace lumel
