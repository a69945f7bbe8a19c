#include "atlas/finish/border_edges.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Grid cells have the mean edge length, but at least this many tolerances.
constexpr double kMinCell = 8.0;
/// Maximum cells along the longest edge: a large ground plane beside small objects would have too
/// many.
constexpr double kMaxAlong = 1e4;
constexpr std::size_t kEdgesPerTask = 256;

struct Cell {
    std::int64_t x, y, z;
    bool operator==(const Cell&) const = default;
};

struct HashOfCell {
    std::size_t operator()(const Cell& cell) const
    {
        return std::size_t(cell.x) * 73856093u ^ std::size_t(cell.y) * 19349663u ^
               std::size_t(cell.z) * 83492791u;
    }
};

/// Ends of edges in a grid, for queries by position.
class Ends {
public:
    Ends(const std::vector<BorderEdge>& edges, double cell, double tolerance)
        : cell_(cell),
          tolerance_(tolerance)
    {
        for (const BorderEdge& edge : edges)
            for (const EdgeEnd& end : edge.ends)
                add(glm::dvec3(end.position));
    }

    /// Ends on an edge except its own, as fractions of its length, in order.
    std::vector<double> on(const BorderEdge& edge) const
    {
        const glm::dvec3 from(edge.ends[0].position), to(edge.ends[1].position);
        const double length = glm::distance(from, to);
        std::vector<double> parts;
        if (!(length > 2.0 * tolerance_))
            return parts;
        const glm::dvec3 along = (to - from) / length;
        const auto steps = std::size_t(std::ceil(length / cell_));
        for (std::size_t step = 0; step < steps; ++step) {
            const glm::dvec3 a = from + along * (length * double(step) / double(steps));
            const glm::dvec3 b = from + along * (length * double(step + 1) / double(steps));
            const Cell low = cell_of(glm::min(a, b) - tolerance_);
            const Cell high = cell_of(glm::max(a, b) + tolerance_);
            for (std::int64_t z = low.z; z <= high.z; ++z)
                for (std::int64_t y = low.y; y <= high.y; ++y)
                    for (std::int64_t x = low.x; x <= high.x; ++x)
                        add_near({x, y, z}, from, along, length, parts);
        }
        std::sort(parts.begin(), parts.end());
        const double same = tolerance_ / length;
        parts.erase(std::unique(parts.begin(), parts.end(),
                                [same](double a, double b) { return b - a <= same; }),
                    parts.end());
        return parts;
    }

private:
    Cell cell_of(const glm::dvec3& point) const
    {
        const glm::dvec3 at = glm::floor(point / cell_);
        return {std::int64_t(at.x), std::int64_t(at.y), std::int64_t(at.z)};
    }

    void add(const glm::dvec3& point)
    {
        std::vector<glm::dvec3>& there = points_[cell_of(point)];
        if (std::none_of(there.begin(), there.end(), [&](const glm::dvec3& known) {
                return glm::distance(known, point) <= 0.5 * tolerance_;
            }))
            there.push_back(point);
    }

    void add_near(const Cell& cell, const glm::dvec3& from, const glm::dvec3& along, double length,
                  std::vector<double>& parts) const
    {
        const auto found = points_.find(cell);
        if (found == points_.end())
            return;
        for (const glm::dvec3& point : found->second) {
            const double at = glm::dot(point - from, along);
            if (at > tolerance_ && at < length - tolerance_ &&
                glm::distance(point, from + at * along) <= tolerance_)
                parts.push_back(at / length);
        }
    }

    double cell_, tolerance_;
    std::unordered_map<Cell, std::vector<glm::dvec3>, HashOfCell> points_;
};

EdgeEnd between(const BorderEdge& edge, double part)
{
    const auto t = float(part);
    const EdgeEnd &a = edge.ends[0], &b = edge.ends[1];
    return {glm::mix(a.position, b.position, t), glm::normalize(glm::mix(a.normal, b.normal, t)),
            glm::mix(a.place, b.place, t)};
}

}  // namespace

void cut_at_ends(std::vector<BorderEdge>& edges, float tolerance)
{
    double length = 0.0, longest = 0.0;
    for (const BorderEdge& edge : edges) {
        const double own = double(glm::distance(edge.ends[0].position, edge.ends[1].position));
        length += own;
        longest = std::max(longest, own);
    }
    if (!(length > 0.0))
        return;
    const double cell = std::max(
        {length / double(edges.size()), longest / kMaxAlong, kMinCell * double(tolerance)});
    const Ends ends(edges, cell, double(tolerance));
    std::vector<std::vector<double>> parts(edges.size());
    parallel_for(edges.size(), kEdgesPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t e = first; e < last; ++e)
            parts[e] = ends.on(edges[e]);
    });
    std::vector<BorderEdge> cut;
    cut.reserve(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
        EdgeEnd last = edges[e].ends[0];
        for (const double part : parts[e]) {
            const EdgeEnd next = between(edges[e], part);
            cut.push_back({{last, next}});
            last = next;
        }
        cut.push_back({{last, edges[e].ends[1]}});
    }
    edges = std::move(cut);
}

}  // namespace lumel
