#pragma once
// What is solved more than once, so that its error can be stated.

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Solutions of links that share nothing random but direct light: two to state the error, and a
/// third to filter them by.
inline constexpr std::uint32_t kSolutions = 3;

/// Estimates of one quantity at the lumels [N].
using Estimates = std::vector<glm::vec3>;
using Solutions = std::array<Estimates, kSolutions>;

}  // namespace lumel
