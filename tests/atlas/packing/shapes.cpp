#include "shapes.h"

#include <cmath>
#include <numbers>

#include "atlas/charts/polygon.h"

namespace lumel::test {

Scene empty_scene()
{
    Scene scene;
    scene.path = "in memory";
    scene.materials.push_back({});
    return scene;
}

Primitive quad(float width, float height)
{
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {width, 0, 0}, {width, height, 0}, {0, height, 0}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return primitive;
}

Primitive box(const glm::vec3& size)
{
    Primitive primitive;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool far : {false, true}) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            glm::vec3 corner(0.0f), edge_u(0.0f), edge_v(0.0f);
            corner[axis] = far ? size[axis] : 0.0f;
            edge_u[u] = size[u];
            edge_v[v] = size[v];
            if (!far)
                std::swap(edge_u, edge_v);
            const std::uint32_t first = std::uint32_t(primitive.positions.size());
            for (const glm::vec3& p :
                 {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v})
                primitive.positions.push_back(p);
            for (std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
                primitive.indices.push_back(first + i);
        }
    return primitive;
}

Primitive sphere(int segments, int rings)
{
    Primitive primitive;
    const float pi = std::numbers::pi_v<float>;
    for (int ring = 0; ring <= rings; ++ring)
        for (int segment = 0; segment < segments; ++segment) {
            const float theta = pi * float(ring) / float(rings);
            const float phi = 2.0f * pi * float(segment) / float(segments);
            const bool pole = ring == 0 || ring == rings;
            const float radius = pole ? 0.0f : std::sin(theta);
            primitive.positions.push_back({radius * std::cos(phi),
                                           pole ? (ring == 0 ? 1.0f : -1.0f) : std::cos(theta),
                                           radius * std::sin(phi)});
        }
    primitive.normals = primitive.positions;
    for (int ring = 0; ring < rings; ++ring)
        for (int segment = 0; segment < segments; ++segment) {
            const auto at = [&](int r, int s) {
                return std::uint32_t(r * segments + s % segments);
            };
            const std::uint32_t a = at(ring, segment), b = at(ring, segment + 1);
            const std::uint32_t c = at(ring + 1, segment + 1), d = at(ring + 1, segment);
            if (ring > 0)
                primitive.indices.insert(primitive.indices.end(), {a, b, c});
            if (ring < rings - 1)
                primitive.indices.insert(primitive.indices.end(), {a, c, d});
        }
    return primitive;
}

Primitive tube(int segments, float height)
{
    Primitive primitive;
    for (int segment = 0; segment < segments; ++segment) {
        const float phi = 2.0f * std::numbers::pi_v<float> * float(segment) / float(segments);
        for (const float y : {0.0f, height})
            primitive.positions.push_back({std::cos(phi), y, std::sin(phi)});
    }
    for (int segment = 0; segment < segments; ++segment) {
        const std::uint32_t a = 2 * segment, b = 2 * ((segment + 1) % segments);
        primitive.indices.insert(primitive.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
    return primitive;
}

Primitive helix(int steps, float turns)
{
    Primitive primitive;
    for (int step = 0; step <= steps; ++step) {
        const float turn = turns * float(step) / float(steps);
        const float phi = 2.0f * std::numbers::pi_v<float> * turn;
        for (const float radius : {1.0f, 2.0f})
            primitive.positions.push_back({radius * std::cos(phi), turn, radius * std::sin(phi)});
    }
    for (std::uint32_t step = 0; step < std::uint32_t(steps); ++step) {
        const std::uint32_t a = 2 * step;
        primitive.indices.insert(primitive.indices.end(), {a, a + 2, a + 1, a + 1, a + 2, a + 3});
    }
    return primitive;
}

int add_mesh(Scene& scene, std::vector<Primitive> primitives, const std::string& name)
{
    scene.meshes.push_back({name, std::move(primitives)});
    return int(scene.meshes.size()) - 1;
}

Scene scene_of_shapes()
{
    Scene scene = empty_scene();
    add_mesh(scene, {box({1.0f, 2.0f, 0.5f})}, "box");
    add_mesh(scene, {sphere(24, 12)}, "ball");
    add_mesh(scene, {helix(60, 3.0f), tube(16, 2.0f)}, "ramp");
    return scene;
}

void add_instance(Scene& scene, int mesh, const glm::mat4& transform)
{
    scene.instances.push_back({"instance", mesh, int(scene.instances.size()), transform});
}

double world_area(const Scene& scene)
{
    double area = 0.0;
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives)
            for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
                glm::dvec3 corner[3];
                for (int c = 0; c < 3; ++c)
                    corner[c] = glm::dmat4(instance.transform) *
                                glm::dvec4(primitive.positions[primitive.indices[i + c]], 1.0);
                area += 0.5 * glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
            }
    return area;
}

double front_area(const Lumels& lumels)
{
    double area = 0.0;
    for (const Lumel& lumel : lumels.lumels)
        if ((lumel.flags & kLumelBack) == 0)
            area += lumel.area;
    return area;
}

std::vector<int> texel_owners(const Atlas& atlas, int& shared_texels)
{
    // Rounding of texture coordinates may reach a hair into the next texel.
    constexpr double kHair = 1e-4;
    std::vector<int> owner(std::size_t(atlas.width) * atlas.height, -1);
    shared_texels = 0;
    for (const Surface& surface : atlas.surfaces)
        for (std::size_t t = 0; t < surface.chart.size(); ++t) {
            const Polygon triangle(glm::dvec2(surface.texcoord[surface.indices[3 * t]]),
                                   glm::dvec2(surface.texcoord[surface.indices[3 * t + 1]]),
                                   glm::dvec2(surface.texcoord[surface.indices[3 * t + 2]]));
            const glm::ivec2 low(glm::floor(triangle.low() + kHair));
            const glm::ivec2 high(glm::ceil(triangle.high() - kHair));
            for (int y = low.y; y < std::max(high.y, low.y + 1); ++y)
                for (int x = low.x; x < std::max(high.x, low.x + 1); ++x) {
                    const Polygon part =
                        clip_to_slab(clip_to_slab(triangle, 0, x, x + 1), 1, y, y + 1);
                    if (part.count < 3)
                        continue;
                    int& at = owner[std::size_t(y) * atlas.width + x];
                    if (at >= 0 && at != int(surface.chart[t]))
                        ++shared_texels;
                    at = int(surface.chart[t]);
                }
        }
    return owner;
}

}  // namespace lumel::test
