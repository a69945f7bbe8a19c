#include "atlas/prepare/lit_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "atlas/near/hemisphere.h"
#include "base/core/lattice.h"
#include "base/core/parallel.h"
#include "scene/values/sky.h"

namespace lumel {
namespace {

/// Walks per side: at least kMinWalks, and about kSharedWalks more in total, by area.
constexpr std::uint32_t kMinWalks = 32, kMaxWalks = 512;
constexpr double kSharedWalks = 1 << 15;
/// A side is lit if one of this many walks finds light: less light, as through cracks in furniture,
/// is invisible.
constexpr std::uint32_t kWalksForLight = 64;
constexpr std::uint32_t kMaxSteps = 24;  ///< steps per walk
/// Walks from each lamp, which light the surfaces that they hit; fewer if there are many lamps.
constexpr std::uint32_t kLampWalks = 256, kMinLampWalks = 16, kAllLampWalks = 1 << 16;
constexpr std::uint32_t kLampSteps = 3;
/// Separates random numbers of emissive surfaces from others; any value serves.
constexpr std::uint32_t kEmitterSeed = 0x5bd1e995u;
/// Inset of walks from the edges of their triangle, relative to it: close to an edge they could
/// start beyond the adjacent wall.
constexpr float kInset = 0.01f;
/// Fraction of a ray before its end at which the walk continues, surely on the same side.
constexpr float kBefore = 1e-3f;

const Primitive& primitive_of(const Scene& scene, const TriangleOf& at)
{
    return scene.meshes[std::size_t(scene.instances[at.instance].mesh)].primitives[at.primitive];
}

const Material& material_of(const Scene& scene, const TriangleOf& at)
{
    return scene.materials[std::size_t(primitive_of(scene, at).material)];
}

bool is_double_sided(const Scene& scene, const TriangleOf& at)
{
    return material_of(scene, at).double_sided;
}

/// A triangle in the world, seen from its front.
struct WorldTriangle {
    std::array<glm::vec3, 3> corner;  ///< [m]
    bool double_sided;

    glm::vec3 normal() const  ///< its length is twice the area
    {
        return glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    }
    /// Uniform by area for a uniform uv.
    glm::vec3 point(glm::vec2 uv) const
    {
        if (uv.x + uv.y > 1.0f)
            uv = 1.0f - uv;
        return corner[0] + uv.x * (corner[1] - corner[0]) + uv.y * (corner[2] - corner[0]);
    }
};

WorldTriangle world_triangle(const Scene& scene, const TriangleOf& at)
{
    const Primitive& primitive = primitive_of(scene, at);
    const glm::mat4& transform = scene.instances[at.instance].transform;
    WorldTriangle triangle{.corner = {}, .double_sided = is_double_sided(scene, at)};
    for (std::uint32_t k = 0; k < 3; ++k)
        triangle.corner[k] =
            glm::vec3(transform *
                      glm::vec4(primitive.positions[primitive.indices[3 * at.triangle + k]], 1.0f));
    if (glm::determinant(glm::mat3(transform)) < 0.0f)
        std::swap(triangle.corner[1], triangle.corner[2]);
    return triangle;
}

/// Triangles, each chosen with a probability in proportion to its area.
class TrianglesByArea {
public:
    void add(const WorldTriangle& triangle)
    {
        triangles_.push_back(triangle);
        sums_.push_back(area() + 0.5 * double(glm::length(triangle.normal())));
    }

    double area() const { return sums_.empty() ? 0.0 : sums_.back(); }  ///< [m²]

    /// at: 0…1. Requires that there is one.
    const WorldTriangle& at(double at) const
    {
        const auto found = std::lower_bound(sums_.begin(), sums_.end(), at * area());
        return triangles_[std::min(std::size_t(found - sums_.begin()), sums_.size() - 1)];
    }

private:
    std::vector<WorldTriangle> triangles_;
    std::vector<double> sums_;  ///< running sums of their areas [m²]
};

/// Position of a walk.
struct Place {
    glm::vec3 position;  ///< [m]
    glm::vec3 normal;    ///< unit, of its side
};

/// The double-sided triangles of a chart.
class ChartSides {
public:
    ChartSides(const Scene& scene, const std::vector<TriangleOf>& chart)
    {
        for (const TriangleOf& at : chart) {
            if (!is_double_sided(scene, at))
                continue;
            triangles_.add(world_triangle(scene, at));
            glows_ |= material_of(scene, at).emitted != glm::vec3(0.0f);
        }
    }

    bool glows() const { return glows_; }

    double area() const { return triangles_.area(); }  ///< [m²]

    /// Start of walk `index` of `count`, offset from the side.
    Place start(bool back, std::uint32_t index, std::uint32_t count) const
    {
        const WorldTriangle& triangle = triangles_.at((double(index) + 0.5) / double(count));
        const auto& [a, b, c] = triangle.corner;
        const glm::vec3 point = triangle.point(sequence_point(index, back ? 1u : 0u));
        const glm::vec3 normal = glm::normalize((back ? -1.0f : 1.0f) * triangle.normal());
        const float ray_offset =
            ray_offset_for(std::max(largest_coordinate(point), longest_edge(a, b, c)));
        return {glm::mix(point, (a + b + c) / 3.0f, kInset) + ray_offset * normal, normal};
    }

private:
    TrianglesByArea triangles_;
    bool glows_ = false;
};

/// True if light of one lamp, chosen by `seed`, reaches the position.
bool sees_lamp(const Scene& scene, const RayScene& rays, const Place& at, std::uint32_t seed)
{
    if (scene.lights.empty())
        return false;
    const PunctualLight& lamp = scene.lights[seed % scene.lights.size()];
    if (!shines(lamp))
        return false;
    if (lamp.kind == PunctualLight::Kind::directional) {
        const glm::vec3 to_lamp = glm::normalize(glm::vec3(lamp.transform[2]));
        return glm::dot(at.normal, to_lamp) > 0.0f && rays.sees_out(at.position, to_lamp, seed);
    }
    const glm::vec3 place(lamp.transform[3]), away = at.position - place;
    return glm::dot(at.normal, away) < 0.0f &&
           intensity_towards(scene, lamp, glm::normalize(away)) != glm::vec3(0.0f) &&
           rays.sees(at.position, place,
                     ray_offset_for(std::max(largest_coordinate(place), glm::length(away))), seed);
}

/// The emissive triangles of a scene. Walks rarely hit a small one, as a bulb in its shade.
class EmissiveTriangles {
public:
    explicit EmissiveTriangles(const Scene& scene)
    {
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
            const std::vector<Primitive>& primitives =
                scene.meshes[std::size_t(scene.instances[i].mesh)].primitives;
            for (std::uint32_t p = 0; p < primitives.size(); ++p)
                if (material_of(scene, {i, p, 0}).emitted != glm::vec3(0.0f))
                    for (std::uint32_t t = 0; t < primitives[p].indices.size() / 3; ++t)
                        triangles_.add(world_triangle(scene, {i, p, t}));
        }
    }

    /// True if light of one of them, chosen by `seed` and area, reaches the position.
    bool light(const RayScene& rays, const Place& at, std::uint32_t seed) const
    {
        if (triangles_.area() == 0.0)
            return false;
        const WorldTriangle& triangle =
            triangles_.at(double(unit_float(mixed_bits(seed ^ kEmitterSeed))));
        const glm::vec3 point =
            triangle.point({unit_float(mixed_bits(seed + 1)), unit_float(mixed_bits(~(seed + 1)))});
        const glm::vec3 away = at.position - point;
        return glm::dot(at.normal, away) < 0.0f &&
               (triangle.double_sided || glm::dot(triangle.normal(), away) > 0.0f) &&
               rays.sees(at.position, point,
                         ray_offset_for(std::max(largest_coordinate(point), glm::length(away))),
                         seed);
    }

private:
    TrianglesByArea triangles_;
};

/// Follows a walk to its end. Returns true if it finds light.
bool finds_light(const Scene& scene, const RayScene& rays, const EmissiveTriangles& emitters,
                 Place at, std::uint32_t key, bool daylit)
{
    for (std::uint32_t step = 0; step < kMaxSteps; ++step) {
        const std::uint32_t seed = mixed_bits(key + step);
        if (sees_lamp(scene, rays, at, seed) || emitters.light(rays, at, seed))
            return true;
        const glm::vec3 direction =
            direction_about(at.normal, {unit_float(seed), unit_float(mixed_bits(~seed))});
        RayHit hit;
        if (!rays.closest(ray_out(at.position, direction, seed), hit))
            return (daylit && direction.y > 0.0f) ||
                   sky_radiance(scene.sky, direction) != glm::vec3(0.0f);
        if (!hit.front && !is_double_sided(scene, hit))
            return false;
        if (material_of(scene, {hit.instance, hit.primitive, hit.triangle}).emitted !=
            glm::vec3(0.0f))
            return true;
        at.position += direction * hit.distance * (1.0f - kBefore);
        at.normal = hit.front ? hit.normal : -hit.normal;
    }
    return false;
}

/// Charts by triangle.
class ChartOfTriangle {
public:
    ChartOfTriangle(const Scene& scene, std::span<const std::vector<TriangleOf>> charts)
        : chart_(scene.instances.size())
    {
        for (std::size_t i = 0; i < chart_.size(); ++i)
            for (const Primitive& primitive :
                 scene.meshes[std::size_t(scene.instances[i].mesh)].primitives)
                chart_[i].emplace_back(primitive.indices.size() / 3, 0u);
        for (std::uint32_t chart = 0; chart < charts.size(); ++chart)
            for (const TriangleOf& at : charts[chart])
                chart_[at.instance][at.primitive][at.triangle] = chart;
    }
    std::uint32_t of(const RayHit& hit) const
    {
        return chart_[hit.instance][hit.primitive][hit.triangle];
    }

private:
    std::vector<std::vector<std::vector<std::uint32_t>>> chart_;
};

/// Uniform over the sphere.
glm::vec3 any_direction(std::uint32_t seed)
{
    const float z = 2.0f * unit_float(mixed_bits(seed)) - 1.0f;
    const float angle = 2.0f * std::numbers::pi_v<float> * unit_float(mixed_bits(~seed));
    const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// [2 × charts] 1 for fronts and backs, alternately, that walks from lamps hit. Walks from sides
/// test one lamp per step and may miss a near one of many.
std::vector<char> lit_by_lamps(const Scene& scene, const RayScene& rays,
                               std::span<const std::vector<TriangleOf>> charts)
{
    std::vector<char> lit(2 * charts.size(), 0);
    const ChartOfTriangle chart(scene, charts);
    const auto lamps = std::uint32_t(scene.lights.size());
    for (std::uint32_t i = 0; i < lamps; ++i) {
        const PunctualLight& lamp = scene.lights[i];
        if (lamp.kind == PunctualLight::Kind::directional || !shines(lamp))
            continue;
        const std::uint32_t walks = std::clamp(kAllLampWalks / lamps, kMinLampWalks, kLampWalks);
        for (std::uint32_t walk = 0; walk < walks; ++walk) {
            std::uint32_t seed = mixed_bits(i * kLampWalks + walk);
            glm::vec3 from(lamp.transform[3]), direction = any_direction(seed);
            if (intensity_towards(scene, lamp, direction) == glm::vec3(0.0f))
                continue;
            RayHit hit;
            for (std::uint32_t step = 0;
                 step < kLampSteps && rays.closest(ray_out(from, direction, seed), hit) &&
                 (hit.front || is_double_sided(scene, hit));
                 ++step) {
                lit[2 * chart.of(hit) + (hit.front ? 0 : 1)] = 1;
                seed = mixed_bits(seed + 1);
                from += direction * hit.distance * (1.0f - kBefore);
                direction = direction_about(hit.front ? hit.normal : -hit.normal,
                                            {unit_float(seed), unit_float(mixed_bits(~seed))});
            }
        }
    }
    return lit;
}

}  // namespace

std::vector<char> lit_on_both_sides(const Scene& scene, const RayScene& rays,
                                    std::span<const std::vector<TriangleOf>> charts, bool daylit)
{
    std::vector<char> both(charts.size(), 0);
    std::vector<ChartSides> sides;
    double all = 0.0;
    for (const std::vector<TriangleOf>& chart : charts) {
        sides.emplace_back(scene, chart);
        all += sides.back().area();
    }
    if (all == 0.0)
        return both;
    const std::vector<char> by_lamps = lit_by_lamps(scene, rays, charts);
    const EmissiveTriangles emitters(scene);
    const auto is_lit = [&](std::size_t chart, bool back) {
        if (sides[chart].glows() || by_lamps[2 * chart + back])
            return true;
        const double share = sides[chart].area() / all;
        const auto walks =
            std::uint32_t(std::clamp(kSharedWalks * share, double(kMinWalks), double(kMaxWalks)));
        std::uint32_t wanted = std::max(1u, walks / kWalksForLight);
        for (std::uint32_t walk = 0; walk < walks && wanted > 0; ++walk) {
            const std::uint32_t key =
                mixed_bits(2 * std::uint32_t(chart) + back) + walk * kMaxSteps;
            wanted -= finds_light(scene, rays, emitters, sides[chart].start(back, walk, walks), key,
                                  daylit);
        }
        return wanted == 0;
    };
    parallel_for(charts.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t chart = first; chart < last; ++chart)
            both[chart] = sides[chart].area() > 0.0 && is_lit(chart, true) && is_lit(chart, false);
    });
    return both;
}

ShowsBoth shows_both(Sides sides, const RayScene& rays, bool daylit)
{
    if (sides == Sides::automatic)
        return
            [&rays, daylit](const Scene& scene, std::span<const std::vector<TriangleOf>> charts) {
                return lit_on_both_sides(scene, rays, charts, daylit);
            };
    if (sides == Sides::both)
        return [](const Scene& scene, std::span<const std::vector<TriangleOf>> charts) {
            std::vector<char> both;
            for (const std::vector<TriangleOf>& chart : charts)
                both.push_back(std::any_of(chart.begin(), chart.end(), [&](const TriangleOf& at) {
                    return is_double_sided(scene, at);
                }));
            return both;
        };
    return {};
}

}  // namespace lumel
