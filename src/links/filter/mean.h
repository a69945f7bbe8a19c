#pragma once
// Mean of several estimates, and its error.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "links/direct/solutions.h"

namespace lumel {

struct Mean {
    Estimates light;           ///< [N] [lx]
    std::vector<float> noise;  ///< [N] its variance, summed over channels
    std::vector<float> wrong;  ///< [N] signed estimate of the squared filter bias
    /// [N] Differences between the estimates, of luminance [lx]; the sum of their squares is its
    /// variance.
    std::vector<glm::vec2> apart;
    /// [N] What the filter changed in the estimates, of luminance [lx]; the mean product of two is
    /// its squared bias.
    std::vector<glm::vec3> bend;
};

/// Sum of squared differences between the three, over channels.
double spread(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Sum of squared errors over some lumels. Estimates of the squared bias are signed; their sum is
/// not negative, and its standard error is added, so that few rays are not trusted too early.
class SquaredError {
public:
    void add(const Mean& mean, std::size_t lumel, double weight = 1.0)
    {
        noise_ += weight * double(mean.noise[lumel]);
        const double wrong = weight * double(mean.wrong[lumel]);
        wrong_ += wrong;
        squares_ += wrong * wrong;
    }
    double sum() const { return noise_ + std::max(wrong_, 0.0) + std::sqrt(squares_); }

private:
    double noise_ = 0.0, wrong_ = 0.0, squares_ = 0.0;
};

/// Mean::apart of three solutions and of two halves.
glm::vec2 apart(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
glm::vec2 apart(const glm::vec3& a, const glm::vec3& b);

/// Of independent solutions, and of two independent halves.
Mean plain_mean(const Solutions& found);
Mean plain_mean(const Estimates& one, const Estimates& other);

}  // namespace lumel
