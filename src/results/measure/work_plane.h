#pragma once
// Points on a horizontal plane, and statistics of their illuminance.

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "results/measure/light_meter.h"

namespace lumel {

/// World space [m].
struct WorkPlane {
    double height = 0.0;             ///< y
    double spacing = 0.0;            ///< between points
    glm::dvec2 low{0.0}, high{0.0};  ///< x and z of two corners
};

/// True if a height lies between the lowest and the highest surface, or at most 3 m above, as a
/// work plane over open ground does [m].
bool is_near_scene(double height, double low, double high);

/// Points row by row from low z on, x fastest, with equal margins on opposite sides.
struct PlaneGrid {
    int columns = 0, rows = 0;
    std::vector<glm::dvec3> points;  ///< [rows][columns] [m]
};

/// Maximum number of points on a plane.
inline constexpr double kMaxPlanePoints = 1e6;

/// At least one point. Throws Error{input} for more than kMaxPlanePoints.
PlaneGrid points_on(const WorkPlane& plane);

/// Statistics over the points that are not inside objects.
struct PlaneFigures {
    std::size_t count = 0;       ///< number of these points
    double least = 0.0;          ///< [lx]
    double mean = 0.0;           ///< [lx]
    double most = 0.0;           ///< [lx]
    double uniformity = 0.0;     ///< least / mean; 0 in the dark
    double noise_of_mean = 0.0;  ///< standard error [lx]
};

PlaneFigures figures_of(std::span<const Reading> readings);

}  // namespace lumel
