#include "atlas/charts/authored.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "atlas/charts/overlap.h"

namespace lumel {

namespace {

// Exporters round: 16-bit coordinates are 1.5e-5 apart.
constexpr double kRangeTolerance = 1e-4;
// Adjacent parts overlap by rounding; this share of a layout is invisible.
constexpr double kAuthoredOverlap = 1e-3;
// Surfaces without area in the layout would get no light.
constexpr double kCollapseTolerance = 1e-3;
// A triangle with less than this share of its expected area has collapsed.
constexpr double kCollapsed = 1e-6;

Polygon layout_triangle(const Primitive& primitive, std::size_t triangle)
{
    const auto corner = [&](int i) {
        const glm::dvec2 place(primitive.texcoords[1][primitive.indices[3 * triangle + i]]);
        return glm::clamp(place, 0.0, 1.0);
    };
    return {corner(0), corner(1), corner(2)};
}

double surface_area(const Primitive& primitive, std::size_t triangle)
{
    const std::uint32_t* index = &primitive.indices[3 * triangle];
    const glm::dvec3 a(primitive.positions[index[0]]);
    return 0.5 * glm::length(glm::cross(glm::dvec3(primitive.positions[index[1]]) - a,
                                        glm::dvec3(primitive.positions[index[2]]) - a));
}

double distance_outside(const Primitive& primitive)
{
    double farthest = 0.0;
    for (std::uint32_t index : primitive.indices) {
        const glm::dvec2 place(primitive.texcoords[1][index]);
        const glm::dvec2 beyond = glm::max(-place, place - 1.0);
        farthest = std::max({farthest, beyond.x, beyond.y});
    }
    return farthest;
}

std::size_t triangle_count(const Mesh& mesh)
{
    std::size_t count = 0;
    for (const Primitive& primitive : mesh.primitives)
        count += primitive.indices.size() / 3;
    return count;
}

/// Area of the mesh's layout that overlaps the grid's contents; adds the mesh to them.
double overlap_with(TriangleGrid& grid, const Mesh& mesh)
{
    double overlap = 0.0;
    for (const Primitive& primitive : mesh.primitives)
        for (std::size_t t = 0; t < primitive.indices.size() / 3; ++t) {
            const Polygon triangle = layout_triangle(primitive, t);
            overlap += grid.covered_area(triangle);
            grid.insert(triangle);
        }
    return overlap;
}

}  // namespace

bool AuthoredReport::valid() const
{
    return present && area > 0.0 && complaint().empty();
}

std::string AuthoredReport::complaint() const
{
    if (!(area > 0.0))
        return "has no area";
    if (outside > kRangeTolerance)
        return fmt::format("leaves 0…1 by {:.3g}", outside);
    if (collapsed > kCollapseTolerance)
        return fmt::format("has no area for {:.3g} per cent of the surface", 100.0 * collapsed);
    if (overlap > kAuthoredOverlap)
        return fmt::format("overlaps itself on {}{:.3g} per cent of its area",
                           overlap_is_least ? "at least " : "", 100.0 * overlap);
    return {};
}

AuthoredReport check_authored(const Mesh& mesh)
{
    AuthoredReport report;
    report.present = !mesh.primitives.empty() &&
                     std::all_of(mesh.primitives.begin(), mesh.primitives.end(),
                                 [](const Primitive& p) { return !p.texcoords[1].empty(); });
    if (!report.present)
        return report;

    double surface = 0.0;
    for (const Primitive& primitive : mesh.primitives) {
        report.outside = std::max(report.outside, distance_outside(primitive));
        for (std::size_t t = 0; t < primitive.indices.size() / 3; ++t) {
            report.area += layout_triangle(primitive, t).area();
            surface += surface_area(primitive, t);
        }
    }
    if (report.outside > kRangeTolerance || !(surface > 0.0))
        return report;
    for (const Primitive& primitive : mesh.primitives)
        for (std::size_t t = 0; t < primitive.indices.size() / 3; ++t) {
            const double share = surface_area(primitive, t) / surface;
            if (layout_triangle(primitive, t).area() <= kCollapsed * share * report.area)
                report.collapsed += share;
        }
    if (report.collapsed > kCollapseTolerance)
        return report;

    // A larger area than the unit square must overlap, and is slow to measure exactly.
    report.overlap_is_least = report.area > 1.0 + kAuthoredOverlap;
    if (report.overlap_is_least) {
        report.overlap = 1.0 - 1.0 / report.area;
    } else {
        TriangleGrid grid(glm::dvec2(0.0), glm::dvec2(1.0), triangle_count(mesh));
        report.overlap = overlap_with(grid, mesh) / report.area;
    }
    return report;
}

bool is_scene_wide(const Scene& scene, const std::vector<AuthoredReport>& reports)
{
    double area = 0.0;
    std::size_t triangles = 0;
    for (const Instance& instance : scene.instances) {
        if (!reports[instance.mesh].valid())
            return false;
        area += reports[instance.mesh].area;
        triangles += triangle_count(scene.meshes[instance.mesh]);
    }
    if (scene.instances.empty() || area > 1.0 + kAuthoredOverlap)
        return false;
    TriangleGrid grid(glm::dvec2(0.0), glm::dvec2(1.0), triangles);
    double overlap = 0.0;
    for (const Instance& instance : scene.instances)
        overlap += overlap_with(grid, scene.meshes[instance.mesh]);
    return overlap <= kAuthoredOverlap * area;
}

Layout authored_layout(const Primitive& primitive)
{
    Layout layout;
    const std::size_t vertex_count = primitive.positions.size();
    layout.indices = primitive.indices;
    layout.source_vertex.resize(vertex_count);
    std::iota(layout.source_vertex.begin(), layout.source_vertex.end(), 0u);
    for (const glm::vec2& place : primitive.texcoords[1])
        layout.place.push_back(glm::clamp(glm::dvec2(place), 0.0, 1.0));

    // Parts are connected where vertices agree in space and in the layout.
    std::vector<std::uint32_t> parent(vertex_count);
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t vertex) {
        while (parent[vertex] != vertex)
            vertex = parent[vertex] = parent[parent[vertex]];
        return vertex;
    };
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        parent[std::max(root(a), root(b))] = std::min(root(a), root(b));
    };
    std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> first_at;
    const std::vector<std::uint32_t> welded = weld(primitive.positions);
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        const glm::vec2 place = primitive.texcoords[1][v];
        join(v, first_at.try_emplace({welded[v], place.x, place.y}, v).first->second);
    }
    for (std::size_t corner = 0; corner < layout.indices.size(); corner += 3) {
        join(layout.indices[corner], layout.indices[corner + 1]);
        join(layout.indices[corner], layout.indices[corner + 2]);
    }

    // Numbers the parts in order of their first triangle.
    std::vector<std::uint32_t> number(vertex_count, kNoNeighbour);
    layout.vertex_chart.assign(vertex_count, 0);
    for (std::size_t corner = 0; corner < layout.indices.size(); ++corner) {
        const std::uint32_t vertex = layout.indices[corner], part = root(vertex);
        if (number[part] == kNoNeighbour) {
            number[part] = std::uint32_t(layout.chart_size.size());
            layout.chart_size.push_back(glm::dvec2(1.0));
        }
        layout.vertex_chart[vertex] = number[part];
        if (corner % 3 == 0)
            layout.chart.push_back(number[part]);
    }
    return layout;
}

}  // namespace lumel
