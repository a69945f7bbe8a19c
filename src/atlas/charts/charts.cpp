// Charts: groups of adjacent triangles with similar normals, projected to a plane.

#include <algorithm>
#include <numeric>
#include <queue>

#include "atlas/charts/flatten.h"
#include "atlas/charts/layout.h"
#include "atlas/charts/overlap.h"

namespace lumel {

namespace {

// Maximum angle of triangles to a chart's mean normal: fewer charts against foreshortened texels.
const double kCosChart = std::cos(glm::radians(50.0));
// The mean drifts while a chart grows; triangles beyond this angle are released.
const double kCosRelease = std::cos(glm::radians(60.0));
// Sharper edges divide charts, so that no lumel bends around a corner.
const double kCosCrease = std::cos(glm::radians(40.0));
// Share of a triangle's area that may overlap another by rounding.
constexpr double kOverlapTolerance = 1e-4;

/// State of cutting a primitive into charts.
struct Cutting {
    const std::vector<std::uint32_t>& indices;
    const std::vector<glm::dvec3>& positions;
    std::vector<std::uint32_t> neighbour;  ///< [3T]
    std::vector<glm::dvec3> normal;        ///< [T] unit, towards the front
    std::vector<double> area;              ///< [T]
    std::vector<std::uint32_t> chart;      ///< [T] kNoChart: not assigned
};
constexpr std::uint32_t kNoChart = ~0u;

void measure_triangles(Cutting& cutting, bool mirrored)
{
    const std::size_t triangle_count = cutting.indices.size() / 3;
    cutting.normal.resize(triangle_count);
    cutting.area.resize(triangle_count);
    cutting.chart.assign(triangle_count, kNoChart);
    for (std::size_t t = 0; t < triangle_count; ++t) {
        const glm::dvec3& a = cutting.positions[cutting.indices[3 * t]];
        const glm::dvec3& b = cutting.positions[cutting.indices[3 * t + 1]];
        const glm::dvec3& c = cutting.positions[cutting.indices[3 * t + 2]];
        const glm::dvec3 doubled = glm::cross(b - a, c - a) * (mirrored ? -1.0 : 1.0);
        const double length = glm::length(doubled);
        cutting.area[t] = 0.5 * length;
        cutting.normal[t] = length > 0.0 ? doubled / length : glm::dvec3(0.0, 0.0, 1.0);
    }
}

/// Unassigned triangles reachable from `seed` that face its direction, best aligned first.
std::vector<std::uint32_t> grow(Cutting& cutting, std::uint32_t seed, std::uint32_t chart)
{
    using Candidate = std::pair<double, std::uint32_t>;  // 1 - cos to the mean, triangle
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
    candidates.push({0.0, seed});
    std::vector<std::uint32_t> members;
    glm::dvec3 sum = cutting.normal[seed] * cutting.area[seed], mean = cutting.normal[seed];
    while (!candidates.empty()) {
        const std::uint32_t t = candidates.top().second;
        candidates.pop();
        if (cutting.chart[t] != kNoChart || glm::dot(cutting.normal[t], mean) < kCosChart)
            continue;
        cutting.chart[t] = chart;
        members.push_back(t);
        sum += cutting.normal[t] * cutting.area[t];
        mean = glm::dot(sum, sum) > 0.0 ? glm::normalize(sum) : mean;
        for (int edge = 0; edge < 3; ++edge) {
            const std::uint32_t other = cutting.neighbour[3 * t + edge];
            if (other != kNoNeighbour && cutting.chart[other] == kNoChart &&
                glm::dot(cutting.normal[t], cutting.normal[other]) > kCosCrease)
                candidates.push({1.0 - glm::dot(cutting.normal[other], mean), other});
        }
    }
    return members;
}

/// Normal of the chart's projection plane: its mean, unless that fails for the seed.
glm::dvec3 projection_axis(const Cutting& cutting, const std::vector<std::uint32_t>& members)
{
    glm::dvec3 sum(0.0);
    for (std::uint32_t t : members)
        sum += cutting.normal[t] * cutting.area[t];
    const glm::dvec3 seed = cutting.normal[members.front()];
    const double length = glm::length(sum);
    return length > 0.0 && glm::dot(sum / length, seed) > kCosRelease ? sum / length : seed;
}

/// Keeps the members that do not overlap in the plane; releases the others. Returns the kept
/// triangles, in the plane.
std::vector<Polygon> keep_flat(Cutting& cutting, std::vector<std::uint32_t>& members,
                               const PlaneFrame& frame, const glm::dvec3& axis)
{
    std::vector<Polygon> kept;
    const auto corner = [&](std::uint32_t t, int i) {
        return frame.project(cutting.positions[cutting.indices[3 * t + i]]);
    };
    glm::dvec2 low(1e300), high(-1e300);
    for (std::uint32_t t : members)
        for (int i = 0; i < 3; ++i) {
            low = glm::min(low, corner(t, i));
            high = glm::max(high, corner(t, i));
        }
    TriangleGrid grid(low, high, members.size());
    std::erase_if(members, [&](std::uint32_t t) {
        const Polygon triangle(corner(t, 0), corner(t, 1), corner(t, 2));
        const bool first = t == members.front();
        const bool fits = glm::dot(cutting.normal[t], axis) > kCosRelease &&
                          grid.covered_area(triangle) <= kOverlapTolerance * triangle.area();
        if (!fits && !first) {
            cutting.chart[t] = kNoChart;
            return true;
        }
        grid.insert(triangle);
        kept.push_back(triangle);
        return false;
    });
    return kept;
}

/// Adds the members' vertices to the layout, turned so that their bounding rectangle is tight.
void lay_out(Cutting& cutting, const std::vector<std::uint32_t>& members, const PlaneFrame& frame,
             std::vector<std::uint32_t>& vertex_of, Layout& layout)
{
    const std::uint32_t chart = std::uint32_t(layout.chart_size.size());
    const std::uint32_t first = std::uint32_t(layout.source_vertex.size());
    for (std::uint32_t t : members) {
        cutting.chart[t] = chart;
        for (std::uint32_t corner = 3 * t; corner < 3 * t + 3; ++corner) {
            const std::uint32_t source = cutting.indices[corner];
            // vertex_of has the last copy of each vertex, possibly for another chart.
            if (vertex_of[source] == kNoNeighbour || vertex_of[source] < first) {
                vertex_of[source] = std::uint32_t(layout.source_vertex.size());
                layout.source_vertex.push_back(source);
                layout.vertex_chart.push_back(chart);
                layout.place.push_back(frame.project(cutting.positions[source]));
            }
            layout.indices[corner] = vertex_of[source];
        }
    }
    layout.chart_size.push_back(
        turn_to_tight_rectangle({layout.place.begin() + first, layout.place.end()}));
}

}  // namespace

Layout make_charts(const Primitive& primitive, const std::vector<glm::dvec3>& positions,
                   bool mirrored, const ChartCost& cost)
{
    Cutting cutting{primitive.indices,
                    positions,
                    neighbours(weld(primitive.positions), primitive.indices),
                    {},
                    {},
                    {}};
    measure_triangles(cutting, mirrored);

    // Largest triangles first: they define the planes.
    std::vector<std::uint32_t> seeds(cutting.area.size());
    std::iota(seeds.begin(), seeds.end(), 0u);
    std::stable_sort(seeds.begin(), seeds.end(), [&](std::uint32_t a, std::uint32_t b) {
        return cutting.area[a] > cutting.area[b];
    });

    Layout layout;
    layout.indices.resize(primitive.indices.size());
    std::vector<std::uint32_t> vertex_of(positions.size(), kNoNeighbour);
    while (!seeds.empty()) {
        for (std::uint32_t seed : seeds) {
            if (cutting.chart[seed] != kNoChart)
                continue;
            const std::uint32_t chart = std::uint32_t(layout.chart_size.size());
            std::vector<std::uint32_t> members = grow(cutting, seed, chart);
            const glm::dvec3 axis = projection_axis(cutting, members);
            const PlaneFrame frame(axis, positions[primitive.indices[3 * seed]]);
            const std::vector<Polygon> flat = keep_flat(cutting, members, frame, axis);
            for (const std::vector<std::uint32_t>& group : split_sparse(flat, cost)) {
                std::vector<std::uint32_t> part;
                for (std::uint32_t i : group)
                    part.push_back(members[i]);
                lay_out(cutting, part, frame, vertex_of, layout);
            }
        }
        // Released triangles start new charts.
        std::erase_if(seeds, [&](std::uint32_t t) { return cutting.chart[t] != kNoChart; });
    }
    layout.chart = std::move(cutting.chart);
    bundle_thin_charts(layout, positions, cost.texels_per_metre);
    return layout;
}

}  // namespace lumel
