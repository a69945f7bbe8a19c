#pragma once
// Small convex polygons in the plane, on the stack, as results of clipping a triangle.

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/glm.hpp>

namespace lumel {

inline double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

/// A convex polygon. A triangle clipped by the four sides of a texel has at most 7 corners.
struct Polygon {
    static constexpr int kMaxCorners = 8;
    std::array<glm::dvec2, kMaxCorners> corner;
    int count = 0;

    Polygon() = default;
    Polygon(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
        : corner{a, b, c},
          count(3)
    {
    }

    glm::dvec2 low() const
    {
        glm::dvec2 result = corner[0];
        for (int i = 1; i < count; ++i)
            result = glm::min(result, corner[i]);
        return result;
    }

    glm::dvec2 high() const
    {
        glm::dvec2 result = corner[0];
        for (int i = 1; i < count; ++i)
            result = glm::max(result, corner[i]);
        return result;
    }

    /// Signed area; positive if the corners turn from +x to +y.
    double signed_area() const
    {
        double twice = 0.0;
        for (int i = 2; i < count; ++i)
            twice += cross(corner[i - 1] - corner[0], corner[i] - corner[0]);
        return 0.5 * twice;
    }

    double area() const { return std::abs(signed_area()); }

    /// Centre of gravity; the mean of the corners if the area is 0.
    glm::dvec2 centroid() const
    {
        glm::dvec2 sum(0.0), mean(0.0);
        double twice = 0.0;
        for (int i = 2; i < count; ++i) {
            const double weight = cross(corner[i - 1] - corner[0], corner[i] - corner[0]);
            sum += weight * (corner[i - 1] + corner[i] - 2.0 * corner[0]) / 3.0;
            twice += weight;
        }
        if (twice != 0.0)
            return corner[0] + sum / twice;
        for (int i = 0; i < count; ++i)
            mean += corner[i] / double(count);
        return mean;
    }

    bool contains(const glm::dvec2& point) const
    {
        const double side = signed_area() < 0.0 ? -1.0 : 1.0;
        for (int i = 0; i < count; ++i) {
            const glm::dvec2 edge = corner[i + 1 < count ? i + 1 : 0] - corner[i];
            if (side * cross(edge, point - corner[i]) < 0.0)
                return false;
        }
        return count >= 3;
    }
};

/// The part of the polygon with dot(normal, p) ≤ offset.
inline Polygon clip(const Polygon& polygon, const glm::dvec2& normal, double offset)
{
    Polygon result;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec2& from = polygon.corner[i];
        const glm::dvec2& to = polygon.corner[i + 1 < polygon.count ? i + 1 : 0];
        const double from_height = glm::dot(normal, from) - offset;
        const double to_height = glm::dot(normal, to) - offset;
        if (from_height <= 0.0 && result.count < Polygon::kMaxCorners)
            result.corner[result.count++] = from;
        const bool crosses =
            (from_height < 0.0 && to_height > 0.0) || (from_height > 0.0 && to_height < 0.0);
        if (crosses && result.count < Polygon::kMaxCorners)
            result.corner[result.count++] =
                from + (to - from) * (from_height / (from_height - to_height));
    }
    return result;
}

/// The part of the polygon in low ≤ p[axis] ≤ high.
inline Polygon clip_to_slab(const Polygon& polygon, int axis, double low, double high)
{
    glm::dvec2 normal(0.0);
    normal[axis] = -1.0;
    const Polygon above = clip(polygon, normal, -low);
    normal[axis] = 1.0;
    return clip(above, normal, high);
}

}  // namespace lumel
