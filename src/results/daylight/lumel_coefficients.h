#pragma once
// Daylight coefficients [TW83] of lumels: what arrives at each from every part of the sky and every
// position of the sun, direct and reflected.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/prepare/solve_scene.h"
#include "base/core/progress_callback.h"

namespace lumel {

struct CoefficientRays {
    std::uint32_t sky = 128;  ///< of a lumel
    /// Shadow rays of all lumels to each position of the sun, at least one each: sunlit
    /// patches get as many whatever the size of lumels.
    std::uint32_t sun = 100'000;
    std::uint32_t links = 96;  ///< of a lumel
    std::uint32_t seed = 1;
};

/// Coefficient of a lumel by its direct light and its light after one bounce and more [lx], for a
/// luminance of 1 cd/m², and for 1 lx on a plane that faces the sun. sources: the 145 patches of
/// SkyPatches(1), then the positions of the sun.
using CoefficientOf = std::function<glm::vec3(std::size_t lumel, std::size_t source,
                                              const glm::vec3& direct, const glm::vec3& reflected)>;

/// [N][sources] Coefficients; those of buried lumels are 0. places: unit directions to the sun.
std::vector<glm::vec3> lumel_coefficients(const SolveScene& scene,
                                          std::span<const glm::vec3> places,
                                          const CoefficientRays& rays, const CoefficientOf& of,
                                          const ProgressCallback& progress = {});

/// Host memory of lumel_coefficients(), about [bytes].
std::uint64_t lumel_coefficient_bytes(std::size_t lumels, std::size_t places);

}  // namespace lumel
