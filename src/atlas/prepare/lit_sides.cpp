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
/// Dark sides are inside a solid if most rays from them are shorter [m]. Dark rooms are wider.
constexpr float kThickest = 1.0f;
/// Least share of the rays from a side that hit something in a room, where light may come in by a
/// window, and in a dark room. Outdoors fewer do.
constexpr double kInRoom = 0.75, kEnclosed = 0.9;
/// Least share of the rays from a side of a dark room that hit another object: the inside of a
/// closed solid is dark and wide, too.
constexpr double kFurnished = 0.125;
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
class DoubleSided {
public:
    DoubleSided(const Scene& scene, const std::vector<TriangleOf>& chart)
        : instance_(chart.empty() ? 0 : chart.front().instance)
    {
        for (const TriangleOf& at : chart) {
            if (!is_double_sided(scene, at))
                continue;
            triangles_.add(world_triangle(scene, at));
            glows_ |= material_of(scene, at).emitted != glm::vec3(0.0f);
        }
    }

    bool glows() const { return glows_; }

    std::uint32_t instance() const { return instance_; }

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
    std::uint32_t instance_;
    TrianglesByArea triangles_;
    bool glows_ = false;
};

/// True if the lamp, switched on, shines along a direction.
bool may_shine(const Scene& scene, PunctualLight lamp, const glm::vec3& direction)
{
    lamp.intensity = 1.0f;
    lamp.color = glm::vec3(1.0f);
    return intensity_towards(scene, lamp, direction) != glm::vec3(0.0f);
}

/// True if light of one lamp, chosen by `seed`, reaches the position.
bool sees_lamp(const Scene& scene, const RayScene& rays, const Place& at, std::uint32_t seed)
{
    if (scene.lights.empty())
        return false;
    const PunctualLight& lamp = scene.lights[seed % scene.lights.size()];
    if (lamp.kind == PunctualLight::Kind::directional) {
        const glm::vec3 to_lamp = glm::normalize(glm::vec3(lamp.transform[2]));
        return glm::dot(at.normal, to_lamp) > 0.0f && rays.sees_out(at.position, to_lamp, seed);
    }
    const glm::vec3 place(lamp.transform[3]), away = at.position - place;
    return glm::dot(at.normal, away) < 0.0f && may_shine(scene, lamp, glm::normalize(away)) &&
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

/// Cosine-distributed about a normal.
glm::vec3 any_about(const glm::vec3& normal, std::uint32_t seed)
{
    return direction_about(normal, {unit_float(seed), unit_float(mixed_bits(~seed))});
}

/// Follows a walk to its end. Returns true if it finds light.
bool finds_light(const Scene& scene, const RayScene& rays, const EmissiveTriangles& emitters,
                 Place at, std::uint32_t key, bool daylit)
{
    for (std::uint32_t step = 0; step < kMaxSteps; ++step) {
        const std::uint32_t seed = mixed_bits(key + step);
        if (sees_lamp(scene, rays, at, seed) || emitters.light(rays, at, seed))
            return true;
        const glm::vec3 direction = any_about(at.normal, seed);
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
        if (lamp.kind == PunctualLight::Kind::directional)
            continue;
        const std::uint32_t walks = std::clamp(kAllLampWalks / lamps, kMinLampWalks, kLampWalks);
        for (std::uint32_t walk = 0; walk < walks; ++walk) {
            std::uint32_t seed = mixed_bits(i * kLampWalks + walk);
            glm::vec3 from(lamp.transform[3]), direction = any_direction(seed);
            if (!may_shine(scene, lamp, direction))
                continue;
            RayHit hit;
            for (std::uint32_t step = 0;
                 step < kLampSteps && rays.closest(ray_out(from, direction, seed), hit) &&
                 (hit.front || is_double_sided(scene, hit));
                 ++step) {
                lit[2 * chart.of(hit) + (hit.front ? 0 : 1)] = 1;
                seed = mixed_bits(seed + 1);
                from += direction * hit.distance * (1.0f - kBefore);
                direction = any_about(hit.front ? hit.normal : -hit.normal, seed);
            }
        }
    }
    return lit;
}

/// Looks for light on the sides of double-sided charts.
class LightOnSides {
public:
    LightOnSides(const Scene& scene, const RayScene& rays,
                 std::span<const std::vector<TriangleOf>> charts, bool daylit)
        : scene_(scene),
          rays_(rays),
          emitters_(scene),
          daylit_(daylit)
    {
        for (const std::vector<TriangleOf>& chart : charts) {
            sides_.emplace_back(scene, chart);
            area_ += sides_.back().area();
        }
        if (area_ > 0.0)
            by_lamps_ = lit_by_lamps(scene, rays, charts);
    }

    ChartSides of(std::size_t chart) const
    {
        ChartSides found;
        if (sides_[chart].area() == 0.0)
            return found;
        std::array<Light, 2> light{};
        for (const bool back : {false, true})
            light[back] = on(chart, back);
        for (const bool back : {false, true})
            if (light[back] == Light::none)
                found.inner[back] = space_at(chart, back).is_narrow();
        const auto lit = std::ranges::count(light, Light::enough);
        const bool lit_side = light[1] == Light::enough;
        found.shows_both = lit == 2 || (lit == 1 && space_at(chart, lit_side).is_room() &&
                                        space_at(chart, !lit_side).is_dark_room());
        return found;
    }

private:
    enum class Light { none, little, enough };
    /// Shares of the rays from a side.
    struct Space {
        double near = 0.0;   ///< that hit something within kThickest
        double hits = 0.0;   ///< that hit something
        double other = 0.0;  ///< that hit another object

        bool is_narrow() const { return near > 0.5; }
        bool is_room() const { return !is_narrow() && hits >= kInRoom; }
        bool is_dark_room() const
        {
            return !is_narrow() && hits >= kEnclosed && other >= kFurnished;
        }
    };

    Light on(std::size_t chart, bool back) const
    {
        if (sides_[chart].glows() || by_lamps_[2 * chart + back])
            return Light::enough;
        const auto walks = std::uint32_t(std::clamp(kSharedWalks * sides_[chart].area() / area_,
                                                    double(kMinWalks), double(kMaxWalks)));
        const std::uint32_t enough = std::max(1u, walks / kWalksForLight);
        std::uint32_t lit = 0;
        for (std::uint32_t walk = 0; walk < walks && lit < enough; ++walk)
            lit += finds_light(scene_, rays_, emitters_, sides_[chart].start(back, walk, walks),
                               seed_of(chart, back, walk), daylit_);
        return lit == 0 ? Light::none : lit < enough ? Light::little : Light::enough;
    }

    /// In front of a side.
    Space space_at(std::size_t chart, bool back) const
    {
        constexpr double kShare = 1.0 / kMinWalks;
        Space space;
        for (std::uint32_t ray = 0; ray < kMinWalks; ++ray) {
            const Place at = sides_[chart].start(back, ray, kMinWalks);
            const std::uint32_t seed = seed_of(chart, back, ray);
            const glm::vec3 direction = any_about(at.normal, seed);
            RayHit hit;
            if (!rays_.closest(ray_out(at.position, direction, seed), hit))
                continue;
            space.hits += kShare;
            space.near += hit.distance < kThickest ? kShare : 0.0;
            // The floor that a solid stands on is at its own bottom.
            const auto is_own = [&](const RayHit& at_hit) {
                return at_hit.instance == sides_[chart].instance();
            };
            if (!is_own(hit) && !rays_.any_at(at.position + hit.distance * direction,
                                              hit.ray_offset, direction, is_own))
                space.other += kShare;
        }
        return space;
    }

    static std::uint32_t seed_of(std::size_t chart, bool back, std::uint32_t walk)
    {
        return mixed_bits(2 * std::uint32_t(chart) + back) + walk * kMaxSteps;
    }

    const Scene& scene_;
    const RayScene& rays_;
    EmissiveTriangles emitters_;
    std::vector<DoubleSided> sides_;  ///< [charts]
    double area_ = 0.0;               ///< of all [m²]
    std::vector<char> by_lamps_;      ///< see lit_by_lamps()
    bool daylit_;
};

}  // namespace

std::vector<ChartSides> light_on_sides(const Scene& scene, const RayScene& rays,
                                       std::span<const std::vector<TriangleOf>> charts, bool daylit)
{
    const LightOnSides light(scene, rays, charts, daylit);
    std::vector<ChartSides> found(charts.size());
    parallel_for(charts.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t chart = first; chart < last; ++chart)
            found[chart] = light.of(chart);
    });
    return found;
}

std::vector<std::array<bool, 2>> find_inner_sides(const Scene& scene, const RayScene& rays,
                                                  const Atlas& atlas)
{
    std::vector<std::vector<TriangleOf>> charts(atlas.chart_count);
    for (const Surface& surface : atlas.surfaces)
        for (std::uint32_t t = 0; t < surface.chart.size(); ++t)
            charts[surface.chart[t]].push_back({surface.instance, surface.primitive, t});
    std::vector<std::array<bool, 2>> inner;
    for (const ChartSides& sides : light_on_sides(scene, rays, charts))
        inner.push_back(sides.inner);
    return inner;
}

Atlas with_inner_sides(const Scene& scene, const RayScene& rays, Atlas atlas)
{
    atlas.inner = find_inner_sides(scene, rays, atlas);
    return atlas;
}

FindSides sides_by_light(Sides wanted, const RayScene& rays, bool daylit)
{
    return [&rays, wanted, daylit](const Scene& scene,
                                   std::span<const std::vector<TriangleOf>> charts) {
        std::vector<ChartSides> sides = light_on_sides(scene, rays, charts, daylit);
        if (wanted == Sides::automatic)
            return sides;
        for (std::size_t chart = 0; chart < charts.size(); ++chart)
            sides[chart].shows_both = wanted == Sides::both &&
                                      std::ranges::any_of(charts[chart], [&](const TriangleOf& at) {
                                          return is_double_sided(scene, at);
                                      });
        return sides;
    };
}

}  // namespace lumel
