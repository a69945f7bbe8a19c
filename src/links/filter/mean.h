#pragma once
// Mean of several estimates, and its error.

#include <cstddef>
#include <vector>

#include "links/direct/solutions.h"

namespace lumel {

struct Mean {
    Estimates light;           ///< [N] [lx]
    std::vector<float> noise;  ///< [N] its variance, summed over channels
    std::vector<float> wrong;  ///< [N] signed estimate of the squared filter bias
};

/// Sum of squared differences between the three, over channels.
double spread(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Sum of squared errors over some lumels.
class SquaredError {
public:
    void add(const Mean& mean, std::size_t lumel)
    {
        add(double(mean.noise[lumel]), double(mean.wrong[lumel]));
    }
    /// Adds a lumel's values as in Mean.
    void add(double noise, double wrong)
    {
        noise_ += noise;
        wrong_ += wrong;
        squares_ += wrong * wrong;
    }
    /// Clamps the squared filter bias at 0 and adds its standard error, so that choosing the better
    /// filter stays conservative.
    double sum() const;

private:
    double noise_ = 0.0, wrong_ = 0.0, squares_ = 0.0;
};

/// Of independent solutions, and of two independent halves.
Mean plain_mean(const Solutions& found);
Mean plain_mean(const Estimates& one, const Estimates& other);

}  // namespace lumel
