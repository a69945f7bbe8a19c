#include "atlas/packing/density.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fnmatch.h>

#include "atlas/charts/layout.h"

namespace lumel {
namespace {

/// Triangles up to this multiple of the median area are detail.
constexpr double kDetail = 2.0;
/// Maximum length of a triangle relative to its distance from the content: 1 / d² then varies
/// little over it.
constexpr double kSmooth = 0.5;
constexpr int kMaxDivisions = 24;

struct ExactBox {
    glm::dvec3 low{1e300}, high{-1e300};

    void add(const glm::dvec3& point)
    {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    double distance(const glm::dvec3& point) const
    {
        return glm::length(glm::max(glm::max(low - point, point - high), glm::dvec3(0.0)));
    }
};

struct Content {
    ExactBox box;
    double viewing_distance = 0.0;  ///< L [m]
};

using Triangle = std::array<glm::dvec3, 3>;

double area_of(const Triangle& t)
{
    return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
}

/// Calls visit(triangle in the world, instance, primitive) for every triangle.
template <class Visit>
void each_triangle(const Scene& scene, const Visit& visit)
{
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const std::vector<std::uint32_t>& indices = mesh.primitives[p].indices;
            const std::vector<glm::dvec3> world =
                world_positions(mesh.primitives[p], instance.transform);
            for (std::size_t t = 0; t < indices.size(); t += 3)
                visit(Triangle{world[indices[t]], world[indices[t + 1]], world[indices[t + 2]]}, i,
                      p);
        }
    }
}

double median_area(const Scene& scene)
{
    std::vector<double> areas;
    each_triangle(scene, [&](const Triangle& triangle, std::size_t, std::size_t) {
        areas.push_back(area_of(triangle));
    });
    const auto middle = areas.begin() + std::ptrdiff_t(areas.size() / 2);
    std::nth_element(areas.begin(), middle, areas.end());
    return *middle;
}

Content content_of(const Scene& scene)
{
    const double largest = kDetail * median_area(scene);
    Content content;
    each_triangle(scene, [&](const Triangle& triangle, std::size_t, std::size_t) {
        if (area_of(triangle) <= largest)
            for (const glm::dvec3& corner : triangle)
                content.box.add(corner);
    });
    for (const Camera& camera : scene.cameras)
        content.box.add(glm::dvec3(camera.transform[3]));
    const glm::dvec3 size = content.box.high - content.box.low;
    const double middle = size.x + size.y + size.z - std::max({size.x, size.y, size.z}) -
                          std::min({size.x, size.y, size.z});
    content.viewing_distance = 0.5 * middle;
    return content;
}

/// ∫ min(1, L / d)² dA over a triangle [m²].
double seen_area(const Content& content, const Triangle& t, int divisions = 0)
{
    const double reach = content.viewing_distance;
    const auto distance = [&](const glm::dvec3& point) { return content.box.distance(point); };
    if (std::all_of(t.begin(), t.end(), [&](const auto& p) { return distance(p) <= reach; }))
        return area_of(t);  // the region within L is convex
    const double d = std::max(distance((t[0] + t[1] + t[2]) / 3.0), reach);
    int longest = 0;
    std::array<double, 3> length;
    for (int e = 0; e < 3; ++e) {
        length[e] = glm::length(t[(e + 1) % 3] - t[e]);
        longest = length[e] > length[longest] ? e : longest;
    }
    if (length[longest] <= kSmooth * d || divisions == kMaxDivisions)
        return area_of(t) * (reach / d) * (reach / d);
    const glm::dvec3 &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
    const glm::dvec3 middle = 0.5 * (a + b);
    return seen_area(content, {a, middle, c}, divisions + 1) +
           seen_area(content, {middle, b, c}, divisions + 1);
}

std::vector<std::vector<Density>> even(const Scene& scene)
{
    std::vector<std::vector<Density>> densities;
    for (const Instance& instance : scene.instances)
        densities.emplace_back(scene.meshes[std::size_t(instance.mesh)].primitives.size());
    return densities;
}

void lower_far_out(const Scene& scene, std::vector<std::vector<Density>>& densities)
{
    const Content content = content_of(scene);
    if (!(content.viewing_distance > 0.0))
        return;                                  // flat content has no viewing distance
    std::vector<std::vector<glm::dvec2>> areas;  // weighted and true area [m²]
    for (const std::vector<Density>& of_instance : densities)
        areas.emplace_back(of_instance.size(), glm::dvec2(0.0));
    each_triangle(scene, [&](const Triangle& triangle, std::size_t i, std::size_t p) {
        areas[i][p] += glm::dvec2(seen_area(content, triangle), area_of(triangle));
    });
    for (std::size_t i = 0; i < areas.size(); ++i)
        for (std::size_t p = 0; p < areas[i].size(); ++p)
            if (areas[i][p].x < areas[i][p].y)
                densities[i][p].relative = std::sqrt(areas[i][p].x / areas[i][p].y);
}

bool matches(const DensityRule& rule, const Scene& scene, const Instance& instance,
             const Primitive& primitive)
{
    const std::string& mesh = scene.meshes[std::size_t(instance.mesh)].name;
    const std::string& material = scene.materials[std::size_t(primitive.material)].name;
    return std::ranges::any_of(std::array{&instance.name, &mesh, &material},
                               [&](const std::string* name) {
                                   return fnmatch(rule.pattern.c_str(), name->c_str(), 0) == 0;
                               });
}

double set_density(const Scene& scene, const Instance& instance, const Primitive& primitive,
                   const std::vector<DensityRule>& rules)
{
    const Material& material = scene.materials[std::size_t(primitive.material)];
    for (auto rule = rules.rbegin(); rule != rules.rend(); ++rule)
        if (matches(*rule, scene, instance, primitive))
            return double(rule->texels_per_metre);
    return double(instance.texels_per_metre > 0.0f ? instance.texels_per_metre
                                                   : material.texels_per_metre);
}

}  // namespace

std::vector<std::vector<Density>> densities_of(const Scene& scene, const AtlasOptions& options)
{
    std::vector<std::vector<Density>> densities = even(scene);
    if (options.coarse_afar)
        lower_far_out(scene, densities);
    for (std::size_t i = 0; i < densities.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        for (std::size_t p = 0; p < densities[i].size(); ++p)
            densities[i][p].fixed =
                set_density(scene, instance, mesh.primitives[p], options.densities);
    }
    return densities;
}

std::vector<std::string> unmatched(const Scene& scene, const std::vector<DensityRule>& rules)
{
    const auto is_used = [&](const DensityRule& rule) {
        return std::ranges::any_of(scene.instances, [&](const Instance& instance) {
            return std::ranges::any_of(
                scene.meshes[std::size_t(instance.mesh)].primitives,
                [&](const Primitive& one) { return matches(rule, scene, instance, one); });
        });
    };
    std::vector<std::string> patterns;
    for (const DensityRule& rule : rules)
        if (!is_used(rule))
            patterns.push_back(rule.pattern);
    return patterns;
}

}  // namespace lumel
