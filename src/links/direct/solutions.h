#pragma once
// Independent solutions, for error estimates.

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Solutions by links that share no random numbers except those of direct light. Three pairs tell
/// noise from light.
inline constexpr std::uint32_t kSolutions = 3;

/// Estimates of one quantity at the lumels [N].
using Estimates = std::vector<glm::vec3>;
using Solutions = std::array<Estimates, kSolutions>;

}  // namespace lumel
