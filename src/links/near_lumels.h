#pragma once
// The lumel that a ray has met.

#include <cstdint>
#include <vector>

#include "nearfield/hit_lumels.h"

namespace lumel {

class NearLumels {
public:
    /// The atlas and the lumels must outlive it.
    NearLumels(const Scene& scene, const Atlas& atlas, const Lumels& lumels);

    /// The lumel at a hit, or where none is the nearest of its instance and side in the texels
    /// around: rays that end in no lumel would darken a closed room without bound. kNoLumel where
    /// there is none, nor for buried ones.
    std::uint32_t lumel(const RayHit& hit) const;

private:
    const Lumels& lumels_;
    HitLumels at_hits_;
    std::vector<std::uint32_t> by_side_;  ///< [texels][2]
};

}  // namespace lumel
