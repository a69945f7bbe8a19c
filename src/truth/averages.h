#pragma once
// Means of random estimates, in parallel.

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Estimates a value from the sample of this number.
using Estimate = std::function<glm::vec4(std::size_t value, std::uint32_t sample)>;

/// Means [count] of `samples` estimates each, independent of the number of threads. `progress`
/// receives the fraction done and returns false to stop; the result then has the samples taken so
/// far, and is empty if some values have none.
std::vector<glm::vec4> average(std::size_t count, int samples, const Estimate& estimate,
                               const std::function<bool(double)>& progress);

}  // namespace lumel
