#pragma once
// Which triangles of a flat layout lie on top of each other.

#include <cstdint>
#include <vector>

#include "atlas/charts/polygon.h"

namespace lumel {

/// Area common to two triangles of any winding. Triangles that share only an edge have none.
double common_area(const Polygon& a, const Polygon& b);

/// Triangles in the plane, found again by place: a uniform grid with about as many cells as
/// triangles.
class TriangleGrid {
public:
    /// All triangles to come lie in low…high; `expected_count` of them.
    TriangleGrid(const glm::dvec2& low, const glm::dvec2& high, std::size_t expected_count);

    /// Area of `triangle` that those already inside cover. Stops counting when it is all covered.
    double covered_area(const Polygon& triangle);

    void insert(const Polygon& triangle);

private:
    template <typename Visit>
    void for_each_cell(const Polygon& triangle, Visit visit) const;

    struct Link {
        std::uint32_t triangle;
        std::int32_t next;
    };
    glm::dvec2 low_, cells_per_unit_;
    int columns_ = 1, rows_ = 1;
    std::vector<std::int32_t> first_;  ///< [rows][columns] index into links_, -1: none
    std::vector<Link> links_;
    std::vector<Polygon> triangles_;
    std::vector<std::uint32_t> seen_;  ///< query in which a triangle was last looked at
    std::uint32_t query_ = 0;
};

}  // namespace lumel
