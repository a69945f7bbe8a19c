#pragma once
// The mean of solutions, and its error.

#include <cstddef>
#include <vector>

#include "links/direct/solutions.h"

namespace lumel {

class ChartFilter;

struct Mean {
    Estimates light;           ///< [N] [lx]
    std::vector<float> noise;  ///< [N] its variance, all channels together
    std::vector<float> wrong;  ///< [N] estimate, of any sign, of the square of a filter's own error
};

/// Squared differences of each two of three, all channels together.
double spread(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Sum of squared errors over some lumels.
class SquaredError {
public:
    void add(const Mean& mean, std::size_t lumel)
    {
        add(double(mean.noise[lumel]), double(mean.wrong[lumel]));
    }
    /// A lumel's, as Mean has them.
    void add(double noise, double wrong)
    {
        noise_ += noise;
        wrong_ += wrong;
        squares_ += wrong * wrong;
    }
    /// What is filtered wrongly cannot be less than nothing. It is known to one standard error,
    /// which counts: of two filters the one whose error seems less would seem better than it is.
    double sum() const;

private:
    double noise_ = 0.0, wrong_ = 0.0, squares_ = 0.0;
};

/// Without a filter if `filter` is null, else filtered where that has less error.
Mean mean_of(const Solutions& found, const ChartFilter* filter);

}  // namespace lumel
