#pragma once
// Lumels at ray hits.

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/near/hit_lumels.h"

namespace lumel {

/// Search radius around a hit without a lumel [texels].
inline constexpr int kHitReach = 2;

class NearLumels {
public:
    /// The atlas must outlive this.
    NearLumels(const Scene& scene, const Atlas& atlas, const Lumels& lumels);

    static std::uint64_t bytes(std::size_t texels)
    {
        return texels * (2 * sizeof(Entry) + 2 * sizeof(std::uint32_t));
    }

    /// The lumel at a hit, else the nearest of its instance and side within kHitReach: rays without
    /// a lumel would darken closed rooms, without bound. kNoLumel if there is none. Ignores buried
    /// lumels.
    std::uint32_t lumel(const RayHit& hit) const;

    /// The same for a batch of hits: faster, as their memory reads overlap. lumels [hits]: kNoLumel
    /// for those of infinite distance.
    void find(std::span<const RayHit> hits, std::vector<std::uint32_t>& lumels) const;

private:
    /// Data of a texel and side, adjacent in memory.
    struct Entry {
        std::uint32_t lumel = kNoLumel, instance = 0;
    };
    /// The lumel of the texel that a place is in, or kNoLumel.
    std::uint32_t own(const glm::vec2& place, const RayHit& hit) const;
    /// The nearest one within kHitReach, or kNoLumel.
    std::uint32_t nearest(const glm::vec2& place, const RayHit& hit) const;
    /// The lumel of an instance and side at a texel, or kNoLumel.
    std::uint32_t at(int x, int y, const RayHit& hit) const;

    HitLumels places_;
    int width_, height_;          ///< atlas size [texels]
    std::vector<Entry> by_side_;  ///< [texels][2]
};

}  // namespace lumel
