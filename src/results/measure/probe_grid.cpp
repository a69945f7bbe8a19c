#include "results/measure/probe_grid.h"

#include "base/core/error.h"

namespace lumel {

std::vector<glm::dvec3> ProbeGrid::points() const
{
    std::vector<glm::dvec3> points;
    points.reserve(std::size_t(counts.x) * std::size_t(counts.y) * std::size_t(counts.z));
    for (int z = 0; z < counts.z; ++z)
        for (int y = 0; y < counts.y; ++y)
            for (int x = 0; x < counts.x; ++x)
                points.push_back(first + spacing * glm::dvec3(x, y, z));
    return points;
}

ProbeGrid probe_grid(const glm::dvec3& low, const glm::dvec3& high, double spacing)
{
    const glm::dvec3 counts = glm::max(glm::floor((high - low) / spacing), 1.0);
    if (counts.x * counts.y * counts.z > kMaxProbes)
        throw Error(ErrorKind::input, "--spacing",
                    "would make more than a million probes; use a wider spacing or --bounds");
    return {.spacing = spacing,
            .first = 0.5 * (low + high) - 0.5 * spacing * (counts - 1.0),
            .counts = glm::ivec3(counts)};
}

}  // namespace lumel
