#pragma once
// Means of random estimates, on all cores.

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// One estimate of a value from its sample of that number.
using Estimate = std::function<glm::vec4(std::size_t value, std::uint32_t sample)>;

/// Means [count] of `samples` estimates each, the same for any number of cores.
/// `progress` is given the fraction done and returns false to stop, which leaves the samples taken
/// so far; none if some values have none yet.
std::vector<glm::vec4> average(std::size_t count, int samples, const Estimate& estimate,
                               const std::function<bool(double)>& progress);

}  // namespace lumel
