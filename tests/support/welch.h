#pragma once
// Whether two solvers have the same mean, whatever their noise.

#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace lumel::support {

/// Welch's t of each lumel's red, between the means of two groups of eight runs. solve(group, seed)
/// gives the irradiance [N] of a run of group 0 or 1. With 2 (8 - 1) degrees of freedom the mean of
/// t² is 7/6 if both have the same mean, and a bias of either would raise it.
template <typename Solve>
std::vector<double> welch_t(const Solve& solve)
{
    constexpr int kRuns = 8;
    constexpr std::uint32_t kFirstSeed = 100;
    std::vector<glm::dvec2> mean, square;  // of each group
    for (std::uint32_t run = 0; run < 2 * kRuns; ++run) {
        const int group = int(run % 2);
        const std::vector<glm::vec3> irradiance = solve(group, kFirstSeed + run);
        mean.resize(irradiance.size());
        square.resize(irradiance.size());
        for (std::size_t i = 0; i < irradiance.size(); ++i) {
            const double H = irradiance[i].x;
            mean[i][group] += H / kRuns;
            square[i][group] += H * H / kRuns;
        }
    }
    std::vector<double> t;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        const glm::dvec2 variance = (square[i] - mean[i] * mean[i]) / double(kRuns - 1);
        t.push_back((mean[i].x - mean[i].y) / std::sqrt(variance.x + variance.y));
    }
    return t;
}

inline double mean_square(const std::vector<double>& values)
{
    double squares = 0.0;
    for (const double value : values)
        squares += value * value / double(values.size());
    return squares;
}

}  // namespace lumel::support
