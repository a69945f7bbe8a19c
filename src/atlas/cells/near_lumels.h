#pragma once
// The lumel that a ray has met.

#include <cstdint>
#include <vector>

#include "atlas/near/hit_lumels.h"

namespace lumel {

/// Texels around a hit without a lumel that are searched for one.
inline constexpr int kHitReach = 2;

class NearLumels {
public:
    /// The atlas must outlive it.
    NearLumels(const Scene& scene, const Atlas& atlas, const Lumels& lumels);

    static std::uint64_t bytes(std::size_t texels)
    {
        return texels * (2 * sizeof(Entry) + 2 * sizeof(std::uint32_t));
    }

    /// The lumel at a hit, or where none is the nearest of its instance and side in the texels
    /// around: rays that end in no lumel would darken a closed room without bound. kNoLumel where
    /// there is none; buried ones do not count.
    std::uint32_t lumel(const RayHit& hit) const;

private:
    /// All that a look at a texel needs, together.
    struct Entry {
        std::uint32_t lumel = kNoLumel, instance = 0;
    };
    /// The lumel of an instance and side at a texel, or kNoLumel.
    std::uint32_t at(int x, int y, const RayHit& hit) const;

    HitLumels places_;
    int width_, height_;          ///< of the atlas [texels]
    std::vector<Entry> by_side_;  ///< [texels][2]
};

}  // namespace lumel
