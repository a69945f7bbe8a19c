#include "atlas/charts/overlap.h"

namespace lumel {

namespace {

constexpr int kMaxCellsPerSide = 1024;  // 4 MiB of list heads

}  // namespace

double common_area(const Polygon& a, const Polygon& b)
{
    if (glm::any(glm::lessThan(a.high(), b.low())) || glm::any(glm::lessThan(b.high(), a.low())))
        return 0.0;
    const double side = b.signed_area() < 0.0 ? -1.0 : 1.0;
    Polygon common = a;
    for (int i = 0; i < b.count && common.count >= 3; ++i) {
        const glm::dvec2 edge = b.corner[i + 1 < b.count ? i + 1 : 0] - b.corner[i];
        const glm::dvec2 outward = side * glm::dvec2(edge.y, -edge.x);
        common = clip(common, outward, glm::dot(outward, b.corner[i]));
    }
    return common.count >= 3 ? common.area() : 0.0;
}

TriangleGrid::TriangleGrid(const glm::dvec2& low, const glm::dvec2& high,
                           std::size_t expected_count)
    : low_(low)
{
    const glm::dvec2 extent = glm::max(high - low, glm::dvec2(1e-300));
    const double aspect = std::clamp(std::sqrt(extent.x / extent.y), 1e-3, 1e3);
    const double side = std::sqrt(double(std::max<std::size_t>(expected_count, 1)));
    columns_ = int(std::clamp(side * aspect, 1.0, double(kMaxCellsPerSide)));
    rows_ = int(std::clamp(side / aspect, 1.0, double(kMaxCellsPerSide)));
    cells_per_unit_ = glm::dvec2(columns_, rows_) / extent;
    first_.assign(std::size_t(columns_) * rows_, -1);
}

template <typename Visit>
void TriangleGrid::for_each_cell(const Polygon& triangle, Visit visit) const
{
    const auto cell_of = [](double place, int count) {
        return int(std::clamp(std::floor(place), 0.0, double(count - 1)));
    };
    Polygon scaled = triangle;
    for (int i = 0; i < scaled.count; ++i)
        scaled.corner[i] = (scaled.corner[i] - low_) * cells_per_unit_;
    const int last_row = cell_of(scaled.high().y, rows_);
    const int first_row = cell_of(scaled.low().y, rows_);
    for (int row = first_row; row <= last_row; ++row) {
        // Rounding may place corners just outside the grid, so its border rows are unbounded.
        const Polygon strip = first_row == last_row
                                  ? scaled
                                  : clip_to_slab(scaled, 1, row == 0 ? -1e300 : row,
                                                 row == rows_ - 1 ? 1e300 : row + 1);
        if (strip.count == 0)
            continue;
        const int last_column = cell_of(strip.high().x, columns_);
        for (int column = cell_of(strip.low().x, columns_); column <= last_column; ++column)
            if (!visit(std::size_t(row) * columns_ + column))
                return;
    }
}

double TriangleGrid::covered_area(const Polygon& triangle)
{
    ++query_;
    const double whole = triangle.area();
    double covered = 0.0;
    for_each_cell(triangle, [&](std::size_t cell) {
        for (std::int32_t at = first_[cell]; at >= 0; at = links_[at].next) {
            const std::uint32_t other = links_[at].triangle;
            if (seen_[other] == query_)
                continue;
            seen_[other] = query_;
            covered += common_area(triangle, triangles_[other]);
            if (covered >= whole)
                return false;
        }
        return true;
    });
    return std::min(covered, whole);
}

void TriangleGrid::insert(const Polygon& triangle)
{
    const std::uint32_t index = std::uint32_t(triangles_.size());
    triangles_.push_back(triangle);
    seen_.push_back(0);
    for_each_cell(triangle, [&](std::size_t cell) {
        links_.push_back({index, first_[cell]});
        first_[cell] = std::int32_t(links_.size() - 1);
        return true;
    });
}

}  // namespace lumel
