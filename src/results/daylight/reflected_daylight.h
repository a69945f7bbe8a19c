#pragma once
// Daylight that lumels send.

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "results/daylight/lumel_coefficients.h"

namespace lumel {

class ReflectedDaylight {
public:
    /// places: unit directions to the sun.
    ReflectedDaylight(const SolveScene& scene, std::span<const glm::vec3> places,
                      const CoefficientRays& rays, const ProgressCallback& progress = {});

    /// Sources, as of CoefficientOf.
    std::size_t count() const { return count_; }
    /// [count()] radiosity [lm/m²] of a lumel, for a luminance of 1 cd/m², and for 1 lx on a plane
    /// that faces the sun.
    const glm::vec3* of(std::size_t lumel) const { return &sent_[lumel * count_]; }

private:
    std::size_t count_;
    std::vector<glm::vec3> sent_;  ///< [N][count_]
};

}  // namespace lumel
