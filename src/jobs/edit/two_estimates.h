#pragma once
// Pairs of independent estimates per lumel.

#include <cmath>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Two independent estimates [N], best used by their mean.
struct TwoEstimates {
    explicit TwoEstimates(std::size_t count)
        : half{std::vector<glm::vec3>(count, glm::vec3(0.0f)),
               std::vector<glm::vec3>(count, glm::vec3(0.0f))}
    {
    }

    glm::vec3 mean(std::size_t i) const { return 0.5f * (half[0][i] + half[1][i]); }

    /// RMSE of the mean over lumels and channels, from the difference.
    double error() const
    {
        double square = 0.0;
        for (std::size_t i = 0; i < half[0].size(); ++i) {
            const glm::dvec3 d = 0.5 * (glm::dvec3(half[0][i]) - glm::dvec3(half[1][i]));
            square += glm::dot(d, d);
        }
        return half[0].empty() ? 0.0 : std::sqrt(square / (3.0 * double(half[0].size())));
    }

    std::vector<glm::vec3> half[2];
};

}  // namespace lumel
