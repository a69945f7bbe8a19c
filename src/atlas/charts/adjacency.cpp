#include "atlas/charts/layout.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace lumel {

std::vector<glm::dvec3> world_positions(const Primitive& primitive, const glm::mat4& transform)
{
    std::vector<glm::dvec3> result;
    result.reserve(primitive.positions.size());
    const glm::dmat4 to_world(transform);
    for (const glm::vec3& position : primitive.positions)
        result.emplace_back(to_world * glm::dvec4(position, 1.0));
    return result;
}

std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions)
{
    // Sorts by position; coincident vertices get the lowest index among them.
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const glm::vec3 &p = positions[a], &q = positions[b];
        return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
    });
    std::vector<std::uint32_t> result(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        result[order[i]] = same ? result[order[i - 1]] : order[i];
    }
    return result;
}

std::vector<std::uint32_t> neighbours(const std::vector<std::uint32_t>& welded,
                                      const std::vector<std::uint32_t>& indices)
{
    struct Edge {
        std::uint32_t low, high;  ///< welded ends
        std::uint32_t corner;     ///< index into indices of its first vertex
        bool forward;             ///< directed from low to high
    };
    std::vector<Edge> edges(indices.size());
    for (std::uint32_t corner = 0; corner < indices.size(); ++corner) {
        const std::uint32_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
        const std::uint32_t a = welded[indices[corner]], b = welded[indices[next]];
        edges[corner] = {std::min(a, b), std::max(a, b), corner, a < b};
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
    });

    std::vector<std::uint32_t> result(indices.size(), kNoNeighbour);
    for (std::size_t first = 0, last; first < edges.size(); first = last) {
        last = first + 1;
        while (last < edges.size() && edges[last].low == edges[first].low &&
               edges[last].high == edges[first].high)
            ++last;
        if (last - first != 2 || edges[first].forward == edges[first + 1].forward)
            continue;
        result[edges[first].corner] = edges[first + 1].corner / 3;
        result[edges[first + 1].corner] = edges[first].corner / 3;
    }
    return result;
}

}  // namespace lumel
