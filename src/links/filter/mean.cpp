#include "links/filter/mean.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/core/luminance.h"

namespace lumel {
namespace {

Mean empty_mean(std::size_t count)
{
    return {Estimates(count), std::vector<float>(count), std::vector<float>(count, 0.0f),
            std::vector<glm::vec2>(count), std::vector<glm::vec3>(count, glm::vec3(0.0f))};
}

}  // namespace

double spread(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    const glm::vec3 ab = a - b, bc = b - c, ca = c - a;
    return double(glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca));
}

glm::vec2 apart(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    // Orthogonal contrasts, each with half the variance of the mean of three.
    return {luminance(a - b) / (2.0f * std::numbers::sqrt3_v<float>),
            luminance(2.0f * c - a - b) / 6.0f};
}

glm::vec2 apart(const glm::vec3& a, const glm::vec3& b)
{
    return {0.5f * luminance(a - b), 0.0f};
}

Mean plain_mean(const Solutions& found)
{
    static_assert(kSolutions == 3);
    const std::size_t count = found[0].size();
    Mean mean = empty_mean(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 &a = found[0][i], &b = found[1][i], &c = found[2][i];
        mean.light[i] = (a + b + c) / 3.0f;
        // Each difference has twice the variance of one, six times that of the mean of three.
        mean.noise[i] = float(spread(a, b, c) / 18.0);
        mean.apart[i] = apart(a, b, c);
    }
    return mean;
}

Mean plain_mean(const Estimates& one, const Estimates& other)
{
    const std::size_t count = one.size();
    Mean mean = empty_mean(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 difference = one[i] - other[i];
        mean.light[i] = 0.5f * (one[i] + other[i]);
        mean.noise[i] = 0.25f * glm::dot(difference, difference);
        mean.apart[i] = apart(one[i], other[i]);
    }
    return mean;
}

}  // namespace lumel
