#include "atlas/finish/seam_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "atlas/finish/border_edges.h"
#include "atlas/lumels/sides.h"

namespace lumel {
namespace {

constexpr float kWeldShare = 1e-5f;     // scene sizes: rounding of vertices
constexpr float kSameNormal = 0.9397f;  // cos 20°: smaller creases count as smooth
constexpr float kSamePlace = 1e-3f;     // [texels] in the atlas: not a seam
constexpr std::size_t kLookAhead = 8;   // partners tried per edge, if many edges coincide

using Edge = BorderEdge;

// Gives points within `tolerance` on every axis the same number.
class Welder {
public:
    explicit Welder(float tolerance) : tolerance_(tolerance) {}

    std::uint32_t number_of(const glm::vec3& point)
    {
        // Cells are larger than the tolerance, so most points need only one cell.
        const auto low = cell_of(point - tolerance_), high = cell_of(point + tolerance_);
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t x = low[0]; x <= high[0]; ++x) {
                    const auto found = cells_.find(key_of({x, y, z}));
                    if (found == cells_.end())
                        continue;
                    for (const std::uint32_t number : found->second)
                        if (near(points_[number], point))
                            return number;
                }
        points_.push_back(point);
        const std::uint32_t number = std::uint32_t(points_.size() - 1);
        cells_[key_of(cell_of(point))].push_back(number);
        return number;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const glm::vec3& point) const
    {
        constexpr double kCellsPerTolerance = 0.125;
        Cell cell;
        for (int axis = 0; axis < 3; ++axis)
            cell[std::size_t(axis)] = std::int64_t(
                std::floor(double(point[axis]) / double(tolerance_) * kCellsPerTolerance));
        return cell;
    }
    static std::uint64_t key_of(const Cell& cell)
    {
        // Cells with colliding keys share a list; near() distinguishes their points.
        return std::uint64_t(cell[0]) * 73856093u ^ std::uint64_t(cell[1]) * 19349663u ^
               std::uint64_t(cell[2]) * 83492791u;
    }
    bool near(const glm::vec3& a, const glm::vec3& b) const
    {
        const glm::vec3 gap = glm::abs(a - b);
        return gap.x <= tolerance_ && gap.y <= tolerance_ && gap.z <= tolerance_;
    }

    float tolerance_;
    std::vector<glm::vec3> points_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

// Corners (3 t + k, towards the triangle's next corner) of edges of only one triangle.
std::vector<std::uint32_t> border_corners(const Surface& surface)
{
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> edges;
    edges.reserve(surface.indices.size());
    for (std::uint32_t corner = 0; corner < surface.indices.size(); ++corner) {
        const std::uint32_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
        const auto ends = std::minmax(surface.indices[corner], surface.indices[next]);
        edges.emplace_back(ends.first, ends.second, corner);
    }
    std::sort(edges.begin(), edges.end());
    const auto same = [&](std::size_t i, std::size_t j) {
        return std::get<0>(edges[i]) == std::get<0>(edges[j]) &&
               std::get<1>(edges[i]) == std::get<1>(edges[j]);
    };
    std::vector<std::uint32_t> borders;
    for (std::size_t i = 0; i < edges.size(); ++i)
        if ((i == 0 || !same(i, i - 1)) && (i + 1 == edges.size() || !same(i, i + 1)))
            borders.push_back(std::get<2>(edges[i]));
    return borders;
}

/// turned: uses the surface's back.
void add_borders(const Scene& scene, const Surface& surface, bool turned, std::vector<Edge>& edges)
{
    const Instance& instance = scene.instances[surface.instance];
    const Primitive& primitive =
        scene.meshes[std::size_t(instance.mesh)].primitives[surface.primitive];
    const glm::mat3 linear(instance.transform);
    const glm::mat3 to_world_normal = glm::transpose(glm::inverse(linear));
    const float handedness = glm::determinant(linear) < 0.0f ? -1.0f : 1.0f;

    const auto position = [&](std::uint32_t corner) {
        const std::uint32_t vertex = surface.source_vertex[surface.indices[corner]];
        return glm::vec3(instance.transform * glm::vec4(primitive.positions[vertex], 1.0f));
    };
    for (const std::uint32_t corner : border_corners(surface)) {
        const std::uint32_t first = corner - corner % 3;
        const std::uint32_t corners[2] = {corner, first + (corner + 1) % 3};
        const glm::vec3 face = handedness * glm::cross(position(first + 1) - position(first),
                                                       position(first + 2) - position(first));
        Edge edge;
        for (int end = 0; end < 2; ++end) {
            const std::uint32_t vertex = surface.indices[corners[end]];
            const glm::vec3 normal = primitive.normals.empty()
                                         ? face
                                         : (turned ? -1.0f : 1.0f) * to_world_normal *
                                               primitive.normals[surface.source_vertex[vertex]];
            edge.ends[end] = {position(corners[end]), glm::normalize(normal),
                              surface.texcoord[vertex]};
        }
        edges.push_back(edge);
    }
}

// Splits overlapping edges, numbers the end points and directs every edge from the lower number to
// the higher.
void weld(std::vector<Edge>& edges)
{
    float size = 0.0f;
    for (const Edge& edge : edges)
        for (const EdgeEnd& end : edge.ends)
            for (int axis = 0; axis < 3; ++axis)
                size = std::max(size, std::abs(end.position[axis]));
    const float tolerance = std::max(size * kWeldShare, std::numeric_limits<float>::min());
    cut_at_ends(edges, tolerance);
    Welder welder(tolerance);
    for (Edge& edge : edges) {
        for (EdgeEnd& end : edge.ends)
            end.point = welder.number_of(end.position);
        if (edge.ends[0].point > edge.ends[1].point)
            std::swap(edge.ends[0], edge.ends[1]);
    }
    std::erase_if(edges, [](const Edge& e) { return e.ends[0].point == e.ends[1].point; });
    std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::pair(a.ends[0].point, a.ends[1].point) <
               std::pair(b.ends[0].point, b.ends[1].point);
    });
}

bool coincide(const Edge& a, const Edge& b)
{
    return a.ends[0].point == b.ends[0].point && a.ends[1].point == b.ends[1].point;
}

// False for normals that are NaN.
bool smooth(const Edge& a, const Edge& b)
{
    return glm::dot(a.ends[0].normal, b.ends[0].normal) >= kSameNormal &&
           glm::dot(a.ends[1].normal, b.ends[1].normal) >= kSameNormal;
}

bool torn(const Edge& a, const Edge& b)
{
    return glm::distance(a.ends[0].place, b.ends[0].place) > kSamePlace ||
           glm::distance(a.ends[1].place, b.ends[1].place) > kSamePlace;
}

}  // namespace

std::vector<Seam> find_seams(const Scene& scene, const Atlas& atlas)
{
    std::vector<Edge> edges;
    for (const Surface& surface : atlas.surfaces) {
        add_borders(scene, surface, false, edges);
        if (has_own_back(atlas, surface))
            add_borders(scene, own_back_of(atlas, surface), true, edges);
    }
    weld(edges);

    // Links each edge to the next one that continues smoothly; chains link all coincident edges.
    std::vector<Seam> seams;
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = i + 1; j < std::min(edges.size(), i + 1 + kLookAhead); ++j) {
            if (!coincide(edges[i], edges[j]))
                break;
            if (!smooth(edges[i], edges[j]))
                continue;
            if (torn(edges[i], edges[j]))
                seams.push_back({{edges[i].ends[0].place, edges[i].ends[1].place},
                                 {edges[j].ends[0].place, edges[j].ends[1].place}});
            break;
        }
    return seams;
}

SeamSizes seam_sizes(const Atlas& atlas)
{
    SeamSizes sizes;
    for (const Surface& surface : atlas.surfaces) {
        const double sides = has_own_back(atlas, surface) ? 2.0 : 1.0;
        for (const std::uint32_t corner : border_corners(surface)) {
            const std::uint32_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
            sizes.edges += std::size_t(sides);
            sizes.length += sides * double(glm::distance(surface.texcoord[surface.indices[corner]],
                                                         surface.texcoord[surface.indices[next]]));
        }
    }
    return sizes;
}

std::uint64_t seam_edge_bytes(std::size_t edges)
{
    // The edges, split, and sorted; and a point for each in a table of cells.
    constexpr std::uint64_t kCopies = 3, kOfPoint = sizeof(glm::dvec3) + 3 * sizeof(void*);
    return edges * (kCopies * sizeof(Edge) + kOfPoint);
}

}  // namespace lumel
