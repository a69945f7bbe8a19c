#pragma once
// Daylight coefficients of lumels.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/prepare/solve_scene.h"
#include "results/daylight/daylight_year.h"

namespace lumel {

struct ReflectedDaylightOptions {
    std::uint32_t sky_rays = 128;  ///< of a lumel
    /// Shadow rays of all lumels to each position of the sun, at least one each: sunlit
    /// patches get as many whatever the size of lumels.
    std::uint32_t sun_rays = 100'000;
    std::uint32_t link_rays = 96;  ///< of a lumel
    std::uint32_t seed = 1;
};

class ReflectedDaylight {
public:
    /// places: unit directions to the sun. progress: 0…1, returns false to stop; the light is then
    /// not complete. Throws Error{input} if it does not fit in memory.
    ReflectedDaylight(const SolveScene& scene, std::span<const glm::vec3> places,
                      const ReflectedDaylightOptions& options,
                      const std::function<bool(double)>& progress = {});

    /// False if progress stopped it.
    bool is_complete() const { return is_complete_; }
    /// Coefficients of a lumel: of the 145 patches of SkyPatches(1), then of the places.
    std::size_t count() const { return count_; }
    /// [count()] radiosity [lm/m²] of a lumel, for a luminance of 1 cd/m², and for 1 lx on a plane
    /// that faces the sun.
    const glm::vec3* of(std::size_t lumel) const { return &sent_[lumel * count_]; }

private:
    std::size_t count_;
    std::vector<glm::vec3> sent_;  ///< [N][count_]
    bool is_complete_ = false;
};

}  // namespace lumel
