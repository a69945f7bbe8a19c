//   [Sho92] K. Shoemake. Uniform Random Rotations. 1992.

#include "links/trace/shared_directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "atlas/packing/morton.h"
#include "base/core/lattice.h"
#include "base/core/sphere.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Directions in a set per ray of a lumel: a quarter of Σ max(0, cos) over the sphere is kept, so
/// that most are drawn at most once.
constexpr double kPerRay = 4.0;
/// Each lumel divides by the sum of its cosines, which biases light by about the squared spread of
/// that sum over normals: 1.8 % for 32 directions, 0.05 % for 1024. Larger sets are not worth their
/// drawings; rays then reuse directions from different points.
constexpr std::uint32_t kMin = 32, kMax = 1024;

/// A uniform random rotation [Sho92].
glm::quat random_rotation(std::uint32_t seed)
{
    const auto number = [&](std::uint32_t k) {
        return PathSamples::to_unit(PathSamples::hash(seed, k));
    };
    constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;
    const float share = number(0), a = kTurn * number(1), b = kTurn * number(2);
    const float near = std::sqrt(1.0f - share), far = std::sqrt(share);
    return {far * std::cos(b), near * std::sin(a), near * std::cos(a), far * std::sin(b)};
}

}  // namespace

SharedDirections::SharedDirections(std::uint32_t side, double rays, std::uint32_t seed)
    : side_(side),
      per_set_(std::clamp(std::uint32_t(std::lround(kPerRay * rays)), kMin, kMax))
{
    std::vector<glm::vec3> even(per_set_);
    for (std::uint32_t d = 0; d < per_set_; ++d)
        even[d] = on_sphere(lattice_point(d, per_set_, 0));
    const auto code = [](const glm::vec3& d) { return morton_code(0.5 + 0.5 * glm::dvec3(d)); };
    std::sort(even.begin(), even.end(),
              [&](const glm::vec3& a, const glm::vec3& b) { return code(a) < code(b); });
    directions_.reserve(std::size_t(side_) * side_ * per_set_);
    for (std::uint32_t set = 0; set < side_ * side_; ++set) {
        const glm::quat turn = random_rotation(PathSamples::hash(seed, set));
        for (const glm::vec3& direction : even)
            directions_.push_back(glm::normalize(turn * direction));
    }
}

std::uint32_t CosineDraw::draw(const glm::vec3& normal, float at)
{
    if (normal != normal_) {
        normal_ = normal;
        float sum = 0.0f;
        for (std::size_t d = 0; d < below_.size(); ++d) {
            sum += std::max(0.0f, glm::dot(normal, directions_->all()[first_ + d]));
            below_[d] = sum;
        }
    }
    const float least = std::nextafter(below_.back(), 0.0f);  // rounding must not reach the end
    const auto found =
        std::upper_bound(below_.begin(), below_.end(), std::min(at * below_.back(), least));
    return first_ + std::uint32_t(found - below_.begin());
}

}  // namespace lumel
