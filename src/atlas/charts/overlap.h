#pragma once
// Overlap of triangles in a flat layout.

#include <cstdint>
#include <vector>

#include "atlas/charts/polygon.h"

namespace lumel {

/// Area common to two triangles of any winding; 0 if they share only an edge.
double common_area(const Polygon& a, const Polygon& b);

/// Triangles in the plane in a uniform grid, with about as many cells as triangles.
class TriangleGrid {
public:
    /// low…high: bounds of all triangles; `expected_count`: their number.
    TriangleGrid(const glm::dvec2& low, const glm::dvec2& high, std::size_t expected_count);

    /// Area of `triangle` covered by the grid's triangles. Stops when it is completely covered.
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
    std::vector<std::uint32_t> seen_;  ///< query that last tested a triangle
    std::uint32_t query_ = 0;
};

}  // namespace lumel
