//   [Sho92] K. Shoemake. Uniform Random Rotations. 1992.

#include "links/rays/shared_directions.h"

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

/// Directions per ray of a lumel: a 16th of Σ max(0, cos) over the sphere is kept. With four, the
/// pattern of the set outlives the filter; with 64, light errs by 6 % more than with own
/// directions.
constexpr double kPerRay = 64.0;
/// Each lumel divides by the sum of its cosines, which biases light by about the squared spread of
/// that sum over normals, < 0.1 %. Larger sets are not worth their drawings; rays then reuse
/// directions from different points.
constexpr std::uint32_t kMin = 512, kMax = 16384;

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

SharedDirections::SharedDirections(double rays, std::uint32_t seed)
    : directions_(std::clamp(std::uint32_t(std::lround(kPerRay * rays)), kMin, kMax))
{
    const auto count = std::uint32_t(directions_.size());
    for (std::uint32_t d = 0; d < count; ++d)
        directions_[d] = on_sphere(lattice_point(d, count, 0));
    const auto code = [](const glm::vec3& d) { return morton_code(0.5 + 0.5 * glm::dvec3(d)); };
    std::sort(directions_.begin(), directions_.end(),
              [&](const glm::vec3& a, const glm::vec3& b) { return code(a) < code(b); });
    const glm::quat turn = random_rotation(seed);
    for (glm::vec3& direction : directions_)
        direction = glm::normalize(turn * direction);
}

std::uint32_t CosineDraw::draw(const glm::vec3& normal, float at)
{
    if (normal != normal_) {
        normal_ = normal;
        float sum = 0.0f;
        for (std::size_t d = 0; d < below_.size(); ++d) {
            sum += std::max(0.0f, glm::dot(normal, directions_->all()[d]));
            below_[d] = sum;
        }
    }
    const float least = std::nextafter(below_.back(), 0.0f);  // rounding must not reach the end
    const auto found =
        std::upper_bound(below_.begin(), below_.end(), std::min(at * below_.back(), least));
    return std::uint32_t(found - below_.begin());
}

}  // namespace lumel
