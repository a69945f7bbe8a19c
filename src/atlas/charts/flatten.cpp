#include "atlas/charts/flatten.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "atlas/charts/polygon.h"

namespace lumel {

namespace {

// Minimum share of the area that a new direction must save: among equals the first one is kept.
constexpr double kWorthTurning = 1e-6;

/// Corners of the convex hull in order (Andrew's monotone chain).
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points)
{
    const auto less = [](const glm::dvec2& a, const glm::dvec2& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    };
    std::sort(points.begin(), points.end(), less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3)
        return points;
    std::vector<glm::dvec2> hull;
    const auto add = [&](const glm::dvec2& point, std::size_t keep) {
        while (hull.size() >= keep + 2 &&
               cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0)
            hull.pop_back();
        hull.push_back(point);
    };
    for (const glm::dvec2& point : points)
        add(point, 0);
    const std::size_t lower = hull.size() - 1;
    for (std::size_t i = points.size() - 1; i-- > 0;)
        add(points[i], lower);
    hull.pop_back();
    return hull;
}

glm::dvec2 extent_along(const std::vector<glm::dvec2>& points, const glm::dvec2& direction)
{
    glm::dvec2 low(1e300), high(-1e300);
    for (const glm::dvec2& point : points) {
        const glm::dvec2 turned(glm::dot(point, direction), cross(direction, point));
        low = glm::min(low, turned);
        high = glm::max(high, turned);
    }
    return high - low;
}

/// Direction of the hull edge with the smallest bounding rectangle.
glm::dvec2 tightest_direction(const std::vector<glm::dvec2>& hull)
{
    glm::dvec2 best(1.0, 0.0);
    double best_area = 1e300;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const glm::dvec2 edge = hull[i + 1 < hull.size() ? i + 1 : 0] - hull[i];
        const double length = glm::length(edge);
        if (!(length > 0.0))
            continue;
        const glm::dvec2 extent = extent_along(hull, edge / length);
        if (extent.x * extent.y < best_area * (1.0 - kWorthTurning)) {
            best_area = extent.x * extent.y;
            best = edge / length;
        }
    }
    return best;
}

}  // namespace

PlaneFrame::PlaneFrame(const glm::dvec3& normal, const glm::dvec3& origin) : origin_(origin)
{
    // +y is up, so that horizontal edges of walls remain horizontal.
    const glm::dvec3 up =
        std::abs(normal.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);
    right_ = glm::normalize(glm::cross(up, normal));
    down_ = glm::cross(right_, normal);
}

glm::dvec2 turn_to_tight_rectangle(std::span<glm::dvec2> points)
{
    const std::vector<glm::dvec2> hull = convex_hull({points.begin(), points.end()});
    glm::dvec2 direction = tightest_direction(hull);
    const glm::dvec2 extent = extent_along(hull, direction);
    if (extent.x < extent.y)
        direction = glm::dvec2(-direction.y, direction.x);

    glm::dvec2 low(1e300), high(-1e300);
    for (glm::dvec2& point : points) {
        point = glm::dvec2(glm::dot(point, direction), cross(direction, point));
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    for (glm::dvec2& point : points)
        point -= low;
    return high - low;
}

}  // namespace lumel
