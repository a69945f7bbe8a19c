#include "links/filter/mean.h"

#include <algorithm>
#include <cmath>

#include "links/filter/filter.h"

namespace lumel {
namespace {

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

double squared_error(const Mean& mean)
{
    SquaredError error;
    for (std::size_t i = 0; i < mean.light.size(); ++i)
        error.add(mean, i);
    return error.sum();
}

}  // namespace

double spread(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    const glm::vec3 ab = a - b, bc = b - c, ca = c - a;
    return double(glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca));
}

double SquaredError::sum() const
{
    return noise_ + std::max(wrong_, 0.0) + std::sqrt(squares_);
}

Mean mean_of(const Solutions& found, const ChartFilter* filter)
{
    Mean best = plain_mean(found);
    if (!filter)
        return best;
    double least = squared_error(best);
    for (Mean& filtered : filter->filter(found))
        if (const double error = squared_error(filtered); error < least) {
            least = error;
            best = std::move(filtered);
        }
    return best;
}

}  // namespace lumel
