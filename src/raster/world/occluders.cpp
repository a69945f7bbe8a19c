#include "raster/world/occluders.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Tolerance for points on a plane, relative to the scene's diagonal: the precision of float
/// positions of a few ten-thousand units.
constexpr float kPlaneTolerance = 2e-6f;

struct WorldTriangle {
    glm::vec3 a, b, c;
};

glm::vec3 to_world(const glm::mat4& transform, const glm::vec3& p)
{
    return glm::vec3(transform * glm::vec4(p, 1.0f));
}

/// Points that are extreme in a fixed set of directions: if one of them lies behind a plane, the
/// others need no test.
std::vector<glm::vec3> extremes(const std::vector<glm::vec3>& points)
{
    constexpr int kDirections = 128;
    constexpr float kGoldenAngle = 2.39996323f;
    std::vector<glm::vec3> result;
    for (int i = 0; i < kDirections; ++i) {
        const float z = 1.0f - 2.0f * (float(i) + 0.5f) / float(kDirections);
        const float r = std::sqrt(1.0f - z * z), phi = kGoldenAngle * float(i);
        const glm::vec3 direction(r * std::cos(phi), r * std::sin(phi), z);
        result.push_back(*std::max_element(points.begin(), points.end(), [&](auto& p, auto& q) {
            return glm::dot(p, direction) < glm::dot(q, direction);
        }));
    }
    return result;
}

/// True if all points are on one side of the triangle's plane.
bool has_one_side(const WorldTriangle& t, const std::vector<glm::vec3>& points, float tolerance)
{
    const glm::vec3 cross = glm::cross(t.b - t.a, t.c - t.a);
    const float length = glm::length(cross);
    if (!(length > 0.0f))
        return true;
    const glm::vec3 normal = cross / length;
    bool above = false, below = false;
    for (const glm::vec3& p : points) {
        const float height = glm::dot(p - t.a, normal);
        above |= height > tolerance;
        below |= height < -tolerance;
        if (above && below)
            return false;
    }
    return true;
}

float diagonal_of(const std::vector<glm::vec3>& points)
{
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::length(high - low);
}

/// For each triangle, given by three corners: true if it is on the convex hull of all corners and
/// the other points. False if the test would take too long.
std::vector<char> find_hull(const std::vector<glm::vec3>& corners,
                            const std::vector<glm::vec3>& others)
{
    constexpr double kMaxTests = 4e9;
    std::vector<char> outer(corners.size() / 3, 0);
    if (corners.empty())
        return outer;
    std::vector<glm::vec3> points = corners;
    points.insert(points.end(), others.begin(), others.end());
    const float tolerance = kPlaneTolerance * diagonal_of(points);
    const auto keep = [&](const std::vector<glm::vec3>& tested) {
        parallel_for(outer.size(), 256, [&](std::size_t first, std::size_t last) {
            for (std::size_t t = first; t < last; ++t)
                outer[t] = outer[t] &&
                           has_one_side({corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]},
                                        tested, tolerance);
        });
    };
    std::fill(outer.begin(), outer.end(), char(1));
    keep(extremes(points));  // decides nearly all triangles off the hull

    const auto before = [](const glm::vec3& a, const glm::vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::sort(points.begin(), points.end(), before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const auto candidates = std::count(outer.begin(), outer.end(), char(1));
    if (double(candidates) * double(points.size()) > kMaxTests)
        std::fill(outer.begin(), outer.end(), char(0));
    else
        keep(points);
    return outer;
}

/// [V] The chart rectangle of each vertex in the atlas, low and high corner [texels].
std::vector<glm::vec4> chart_corners(const Surface& surface)
{
    std::map<std::uint32_t, glm::vec4> corners;
    for (std::size_t k = 0; k < surface.indices.size(); ++k) {
        const glm::vec2 place = surface.texcoord[surface.indices[k]];
        const auto [chart, is_new] =
            corners.try_emplace(surface.chart[k / 3], glm::vec4(place, place));
        if (!is_new)
            chart->second = glm::vec4(glm::min(glm::vec2(chart->second), place),
                                      glm::max(glm::vec2(chart->second.z, chart->second.w), place));
    }
    std::vector<glm::vec4> of_vertices(surface.texcoord.size(), glm::vec4(0.0f));
    for (std::size_t k = 0; k < surface.indices.size(); ++k)
        of_vertices[surface.indices[k]] = corners[surface.chart[k / 3]];
    return of_vertices;
}

/// Appends one primitive of one instance to the vertex arrays.
std::uint32_t append_vertices(Occluders& out, const Primitive& primitive, std::uint32_t instance,
                              const Material& material, const Surface* surface)
{
    const auto base = std::uint32_t(out.positions.size());
    const TextureUse& use = material.base_color_texture;
    const auto& uv = primitive.texcoords[use.texcoord];
    const std::size_t count = surface ? surface->source_vertex.size() : primitive.positions.size();
    if (surface) {
        const std::vector<glm::vec4> corners = chart_corners(*surface);
        out.chart.insert(out.chart.end(), corners.begin(), corners.end());
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t v = surface ? surface->source_vertex[i] : i;
        if (surface)
            out.place.push_back(surface->texcoord[i]);
        out.positions.push_back(primitive.positions[v]);
        out.instances.push_back(instance);
        const glm::vec3 at = uv.empty() ? glm::vec3(0.0f) : use.transform * glm::vec3(uv[v], 1.0f);
        const float alpha = primitive.colors.empty() ? 1.0f : primitive.colors[v].a;
        out.look.emplace_back(at.x, at.y, alpha * material.base_color.a);
    }
    return base;
}

/// Corners of boxes around the lamps, which the hull must contain.
std::vector<glm::vec3> lamp_corners(const Scene& scene)
{
    std::vector<glm::vec3> corners;
    for (const PunctualLight& light : scene.lights)
        if (light.kind != PunctualLight::Kind::directional)
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
                corners.push_back(glm::vec3(light.transform[3]) + light.radius * side);
            }
    return corners;
}

struct IndexLists {
    std::vector<std::uint32_t> still, moving, hull;
};

OccluderRange append_indices(Occluders& out, const IndexLists& lists)
{
    const auto inner = std::uint32_t(lists.still.size() + lists.moving.size());
    const OccluderRange range{.first_index = std::uint32_t(out.indices.size()),
                              .still_count = std::uint32_t(lists.still.size()),
                              .inner_count = inner,
                              .index_count = inner + std::uint32_t(lists.hull.size())};
    for (const auto* list : {&lists.still, &lists.moving, &lists.hull})
        out.indices.insert(out.indices.end(), list->begin(), list->end());
    return range;
}

}  // namespace

std::vector<std::uint32_t> Occluders::inner_indices() const
{
    std::vector<std::uint32_t> inner;
    const auto append = [&](const OccluderRange& range) {
        const auto first = indices.begin() + range.first_index;
        inner.insert(inner.end(), first, first + range.inner_count);
    };
    append(opaque);
    for (const CutOut& cut_out : cut_outs)
        append(cut_out.range);
    return inner;
}

Occluders find_occluders(const Scene& scene, const std::vector<char>& movers, const Atlas* atlas)
{
    const bool with_hull = std::none_of(movers.begin(), movers.end(), [](char m) { return m; });
    std::vector<glm::vec3> points;
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives)
            for (const std::uint32_t index : primitive.indices)
                points.push_back(to_world(instance.transform, primitive.positions[index]));
    const std::vector<char> outer = with_hull ? find_hull(points, lamp_corners(scene))
                                              : std::vector<char>(points.size() / 3, 0);

    Occluders out;
    IndexLists opaque;
    std::vector<IndexLists> per_material(scene.materials.size());
    std::size_t triangle = 0, surface_index = 0;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const bool moves = i < movers.size() && movers[i];
        const bool mirrored = glm::determinant(glm::mat3(scene.instances[i].transform)) < 0.0f;
        for (const Primitive& primitive : scene.meshes[scene.instances[i].mesh].primitives) {
            // Surfaces have the same order.
            const Surface* surface = atlas ? &atlas->surfaces[surface_index++] : nullptr;
            const Material& material = scene.materials[primitive.material];
            const std::uint32_t base = append_vertices(out, primitive, i, material, surface);
            IndexLists& lists =
                may_be_transparent(material, primitive) ? per_material[primitive.material] : opaque;
            for (std::size_t k = 0; k + 2 < primitive.indices.size(); k += 3, ++triangle) {
                std::vector<std::uint32_t>& indices = moves             ? lists.moving
                                                      : outer[triangle] ? lists.hull
                                                                        : lists.still;
                const std::vector<std::uint32_t>& corners =
                    surface ? surface->indices : primitive.indices;
                for (const int c : {0, mirrored ? 2 : 1, mirrored ? 1 : 2})
                    indices.push_back(base + corners[k + std::size_t(c)]);
            }
        }
    }
    out.opaque = append_indices(out, opaque);
    for (std::size_t m = 0; m < per_material.size(); ++m)
        if (!per_material[m].still.empty() || !per_material[m].moving.empty() ||
            !per_material[m].hull.empty())
            out.cut_outs.push_back({int(m), append_indices(out, per_material[m])});
    return out;
}

}  // namespace lumel
