#include "results/measure/work_plane.h"

#include <algorithm>
#include <cmath>

#include "base/core/error.h"

namespace lumel {

bool is_near_scene(double height, double low, double high)
{
    constexpr double kAboveGround = 3.0, kSlack = 1e-3;  // [m]
    return height >= low - kSlack && height <= high + kAboveGround;
}

PlaneGrid points_on(const WorkPlane& plane)
{
    const glm::dvec2 size = plane.high - plane.low;
    const glm::dvec2 counts = glm::max(glm::floor(size / plane.spacing), 1.0);
    if (counts.x * counts.y > kMaxPlanePoints)
        throw Error(ErrorKind::input, "--spacing",
                    "would make more than a million points; use a wider spacing or --bounds");
    PlaneGrid grid{.columns = int(counts.x), .rows = int(counts.y)};
    const glm::dvec2 first = 0.5 * (plane.low + plane.high) - 0.5 * plane.spacing * (counts - 1.0);
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column)
            grid.points.emplace_back(first.x + column * plane.spacing, plane.height,
                                     first.y + row * plane.spacing);
    return grid;
}

PlaneFigures figures_of(std::span<const Reading> readings)
{
    PlaneFigures figures;
    double squares = 0.0;
    for (const Reading& reading : readings) {
        if (reading.inside)
            continue;
        figures.least = figures.count == 0 ? reading.lux : std::min(figures.least, reading.lux);
        figures.most = std::max(figures.most, reading.lux);
        figures.mean += reading.lux;
        squares += reading.noise * reading.noise;
        ++figures.count;
    }
    if (figures.count == 0)
        return figures;
    figures.mean /= double(figures.count);
    figures.noise_of_mean = std::sqrt(squares) / double(figures.count);
    figures.uniformity = figures.mean > 0.0 ? figures.least / figures.mean : 0.0;
    return figures;
}

}  // namespace lumel
