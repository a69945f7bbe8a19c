#include "links/filter/mean.h"

#include <algorithm>
#include <cmath>

namespace lumel {

double spread(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    const glm::vec3 ab = a - b, bc = b - c, ca = c - a;
    return double(glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca));
}

Mean plain_mean(const Solutions& found)
{
    static_assert(kSolutions == 3);
    const std::size_t count = found[0].size();
    Mean mean{Estimates(count), std::vector<float>(count), std::vector<float>(count, 0.0f)};
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 &a = found[0][i], &b = found[1][i], &c = found[2][i];
        mean.light[i] = (a + b + c) / 3.0f;
        // Each difference has twice the variance of one, six times that of the mean of three.
        mean.noise[i] = float(spread(a, b, c) / 18.0);
    }
    return mean;
}

Mean plain_mean(const Estimates& one, const Estimates& other)
{
    const std::size_t count = one.size();
    Mean mean{Estimates(count), std::vector<float>(count), std::vector<float>(count, 0.0f)};
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 apart = one[i] - other[i];
        mean.light[i] = 0.5f * (one[i] + other[i]);
        mean.noise[i] = 0.25f * glm::dot(apart, apart);
    }
    return mean;
}

}  // namespace lumel
