#pragma once
// Small scenes and their lumels made by hand, so that a test depends on neither glTF nor charts.
//
// A Quad is a parallelogram seen from the side that cross(edge_u, edge_v) points to. Each quad
// becomes a mesh with one instance; its lumels are a grid of res_u x res_v parallelograms.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"
#include "scene/values/scene.h"

namespace lumel::support {

struct Quad {
    glm::vec3 corner{0.0f};  ///< [m]
    glm::vec3 edge_u{1.0f, 0.0f, 0.0f};
    glm::vec3 edge_v{0.0f, 1.0f, 0.0f};
    glm::vec3 albedo{0.5f};
    glm::vec3 emission{0.0f};  ///< E [lm/m²]
    int res_u = 1;
    int res_v = 1;
    bool double_sided = false;
};

/// A scene of quads, and their lumels row by row (u fastest), quad after quad.
struct HandMade {
    Scene scene;
    Lumels lumels;
    std::vector<std::size_t> first;  ///< [quads + 1] lumels of quad q are [first[q], first[q + 1])
};

inline constexpr float kPi = 3.14159265358979f;

/// A triangle list as a mesh of its own, placed by `transform`, with the quad's material.
inline void add_mesh(Scene& scene, const std::vector<glm::vec3>& positions,
                     const std::vector<std::uint32_t>& indices, const Material& material,
                     const glm::mat4& transform = glm::mat4(1.0f))
{
    Primitive primitive;
    primitive.positions = positions;
    primitive.indices = indices;
    primitive.material = int(scene.materials.size());
    scene.materials.push_back(material);
    Mesh mesh;
    mesh.primitives.push_back(std::move(primitive));
    Instance instance;
    instance.mesh = int(scene.meshes.size());
    instance.node = int(scene.instances.size());
    instance.transform = transform;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back(std::move(instance));
}

inline void add_quad(Scene& scene, const Quad& quad, const glm::mat4& transform = glm::mat4(1.0f))
{
    Material material;
    material.base_color = glm::vec4(quad.albedo, 1.0f);
    material.emitted = quad.emission / kPi;
    material.double_sided = quad.double_sided;
    const glm::vec3 a = quad.corner;
    add_mesh(scene, {a, a + quad.edge_u, a + quad.edge_u + quad.edge_v, a + quad.edge_v},
             {0, 1, 2, 0, 2, 3}, material, transform);
    Primitive& primitive = scene.meshes.back().primitives.back();
    for (auto& texcoords : primitive.texcoords)
        texcoords = {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}};
}

/// Cuts the quad into a grid of lumels with one parallelogram piece each.
inline void add_lumels(Lumels& lumels, const Quad& quad, std::uint32_t instance,
                       const glm::mat4& transform = glm::mat4(1.0f))
{
    const glm::vec3 u = quad.edge_u / float(quad.res_u);
    const glm::vec3 v = quad.edge_v / float(quad.res_v);
    const glm::mat3 to_world(transform);
    const float area = glm::length(glm::cross(to_world * u, to_world * v));
    const float across = std::max(glm::length(to_world * (u + v)), glm::length(to_world * (u - v)));
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (int y = 0; y < quad.res_v; ++y)
        for (int x = 0; x < quad.res_u; ++x) {
            const glm::vec3 origin = quad.corner + float(x) * u + float(y) * v;
            Lumel lumel{};
            lumel.position = origin + 0.5f * (u + v);
            lumel.normal = normal;
            lumel.area = area;
            lumel.size = std::max(std::sqrt(area), across / std::sqrt(2.0f));
            lumel.albedo = quad.albedo;
            lumel.emission = quad.emission;
            lumel.instance = instance;
            lumel.chart = instance;
            lumel.texel = std::uint32_t(lumels.lumels.size());
            lumel.first_piece = std::uint32_t(lumels.pieces.size());
            lumel.piece_count = 1;
            lumels.lumels.push_back(lumel);
            lumels.pieces.push_back({origin, u, v, normal, 1.0f, 1});
        }
    lumels.width = int(lumels.lumels.size());
    lumels.height = 1;
    lumels.coverage.assign(lumels.lumels.size(), 1.0f);
}

inline HandMade make_quads(const std::vector<Quad>& quads)
{
    HandMade made;
    for (const Quad& quad : quads) {
        made.first.push_back(made.lumels.lumels.size());
        add_lumels(made.lumels, quad, std::uint32_t(made.scene.instances.size()));
        add_quad(made.scene, quad);
    }
    made.first.push_back(made.lumels.lumels.size());
    return made;
}

/// Lays the quads out one below the other in an atlas, and their lumels with them.
inline Atlas lay_out(HandMade& made, const std::vector<Quad>& quads)
{
    Atlas atlas;
    for (const Quad& quad : quads) {
        atlas.width = std::max(atlas.width, quad.res_u);
        atlas.height += quad.res_v;
    }
    made.lumels.width = atlas.width;
    made.lumels.height = atlas.height;
    made.lumels.coverage.assign(std::size_t(atlas.width) * std::size_t(atlas.height), 0.0f);
    int row = 0;
    for (std::size_t q = 0; q < quads.size(); row += quads[q].res_v, ++q) {
        const auto width = float(quads[q].res_u), top = float(row),
                   bottom = float(row + quads[q].res_v);
        atlas.surfaces.push_back(
            {.instance = std::uint32_t(q),
             .source_vertex = {0, 1, 2, 3},
             .texcoord = {{0, top}, {width, top}, {width, bottom}, {0, bottom}},
             .indices = {0, 1, 2, 0, 2, 3},
             .chart = {std::uint32_t(q), std::uint32_t(q)}});
        for (std::size_t i = made.first[q]; i < made.first[q + 1]; ++i) {
            const std::size_t k = i - made.first[q], columns = std::size_t(quads[q].res_u);
            const std::size_t texel =
                (std::size_t(row) + k / columns) * std::size_t(atlas.width) + k % columns;
            made.lumels.lumels[i].texel = std::uint32_t(texel);
            made.lumels.coverage[texel] = 1.0f;
        }
    }
    atlas.chart_count = std::uint32_t(quads.size());
    return atlas;
}

/// The six walls of a box in the order -x, +x, -y, +y, -z, +z. `inward`: seen from inside.
inline std::array<Quad, 6> box_walls(const glm::vec3& low, const glm::vec3& high, bool inward,
                                     const Quad& look = {})
{
    const glm::vec3 size = high - low;
    std::array<Quad, 6> walls;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            glm::vec3 u(0.0f), v(0.0f);
            u[(axis + 1) % 3] = size[(axis + 1) % 3];
            v[(axis + 2) % 3] = size[(axis + 2) % 3];  // cross(u, v) points along +axis
            Quad wall = look;
            wall.corner = low;
            if (side == 1)
                wall.corner[axis] = high[axis];
            const bool swapped = (side == 1) == inward;
            wall.edge_u = swapped ? v : u;
            wall.edge_v = swapped ? u : v;
            walls[std::size_t(axis * 2 + side)] = wall;
        }
    return walls;
}

}  // namespace lumel::support
