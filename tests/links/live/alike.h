#pragma once
// How far light of a live scene is from that of one prepared from nothing.

#include <cmath>

#include "links/live/live_links.h"

namespace lumel::test {

using Lights = std::vector<glm::vec3>;

/// RMSE of the lumels between 0.5 and 30 % of the mean, as a part of their own. 0 where there are
/// none.
inline double dark_error(const Lights& values, const Lights& truth)
{
    const auto of = [](const glm::vec3& light) { return double(light.r + light.g + light.b); };
    double mean = 0.0, squares = 0.0, light = 0.0, count = 0.0;
    for (const glm::vec3& one : truth)
        mean += of(one) / double(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
        if (of(truth[i]) > 0.005 * mean && of(truth[i]) < 0.3 * mean) {
            squares += std::pow(of(values[i]) - of(truth[i]), 2.0);
            light += of(truth[i]);
            count += 1.0;
        }
    return light > 0.0 ? std::sqrt(squares * count) / light : 0.0;
}

/// How many links differ, and how many lumels' direct light.
inline std::size_t different(LiveLinks& one, LiveLinks& other)
{
    std::size_t count = 0;
    const Lights a = one.direct(), b = other.direct();
    for (std::size_t i = 0; i < a.size(); ++i) {
        count += a[i] != b[i];
        for (std::uint32_t k = 0; k < one.links().rays(); ++k)
            count += one.links().of(i)[k] != other.links().of(i)[k];
    }
    return count;
}

}  // namespace lumel::test
