#pragma once
// Allocation of a point's shadow rays to light sources.

#include <cstdint>
#include <vector>

#include "lights/sources.h"

namespace lumel {

/// Rays per source at one point.
struct RayAllocation {
    struct Own {
        std::size_t source;
        std::uint32_t rays;
    };
    /// A source sampled from those that share rays.
    struct Chosen {
        std::size_t source;
        float chance;  ///< probability of the choice; 0: none
    };
    /// mark: uniform sample in [0, 1).
    Chosen choose(float mark) const;

    std::vector<Own> own;         ///< sources with their own rays
    std::vector<float> rest;      ///< [sources] running sums of the sampling weights of the others
    std::uint32_t rest_rays = 0;  ///< rays shared by the others
};

/// Allocates about `rays` rays by sampling weight. Weak sources share rays, unless all can have
/// their own; those that cannot be seen get none.
RayAllocation allocate_rays(const LightSources& sources, const Receiver& receiver,
                            std::uint32_t rays);

}  // namespace lumel
