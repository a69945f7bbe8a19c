#pragma once
// How many rays one point sends to which source.

#include <cstdint>
#include <functional>
#include <vector>

#include "lights/sources.h"

namespace lumel {

/// Sources as one point has rays for them.
struct RayAllocation {
    struct Own {
        std::size_t source;
        std::uint32_t rays;
    };
    /// A source that stands for all that share rays.
    struct Chosen {
        std::size_t source;
        float chance;  ///< with which it was chosen; 0: none
    };
    /// mark: in [0, 1).
    Chosen choose(float mark) const;

    std::vector<Own> own;         ///< that have rays of their own
    std::vector<float> rest;      ///< [sources] running sums of the guesses of the others
    std::uint32_t rest_rays = 0;  ///< that these share
};

/// Sources have rays in proportion to what they may send; those that would have very few share
/// theirs, unless there are rays for all. rays: about so many in all. `counts`: which sources.
RayAllocation allocate_rays(const LightSources& sources, const glm::vec3& position,
                            std::uint32_t rays,
                            const std::function<bool(std::size_t)>& counts = {});

}  // namespace lumel
