// Inside a sphere every point receives the same irradiance S, whatever its patches are made of:
//
//     H = S = ⟨E⟩ / (1 - ⟨ρ⟩),      ⟨·⟩ = area average.
//
// A uniform room cannot reveal swapped indices; this one can.

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "../support/box_lumels.h"
#include "../support/closed_forms.h"
#include "truth/reference.h"

namespace lumel {
namespace {

/// An icosahedron's faces, each split into side² facets on the unit sphere and seen from inside.
/// One face: one mesh, one material, one lumel of many triangular pieces.
support::HandMade patchwork_sphere(int side)
{
    const float t = (1.0f + std::sqrt(5.0f)) / 2.0f;
    const glm::vec3 corners[12] = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                                   {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                                   {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
    const int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                              {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                              {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                              {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    support::HandMade made;
    for (int face = 0; face < 20; ++face) {
        const glm::vec3 a = corners[faces[face][0]];
        const glm::vec3 b = corners[faces[face][1]];
        const glm::vec3 c = corners[faces[face][2]];
        std::vector<glm::vec3> positions;
        std::vector<std::uint32_t> indices;
        const auto facet = [&](int u0, int v0, int u1, int v1, int u2, int v2) {
            for (const auto& [u, v] : {std::pair{u0, v0}, {u1, v1}, {u2, v2}}) {
                indices.push_back(std::uint32_t(positions.size()));
                positions.push_back(glm::normalize(a + (b - a) * float(u) / float(side) +
                                                   (c - a) * float(v) / float(side)));
            }
        };
        for (int v = 0; v < side; ++v)
            for (int u = 0; u < side - v; ++u) {
                facet(u, v, u, v + 1, u + 1, v);
                if (u + v + 1 < side)
                    facet(u + 1, v, u, v + 1, u + 1, v + 1);
            }

        Lumel lumel{};
        lumel.instance = std::uint32_t(face);
        lumel.first_piece = std::uint32_t(made.lumels.pieces.size());
        lumel.piece_count = std::uint32_t(positions.size() / 3);
        lumel.albedo = glm::vec3(float(face) / 20.0f, float((face * 7) % 20) / 20.0f, 0.5f);
        const int bright = (face * 13) % 20;
        lumel.emission = bright < 12 ? glm::vec3(0.0f) : glm::vec3(bright, 20 - bright, 1.0f);
        for (std::size_t i = 0; i < positions.size(); i += 3) {
            const glm::vec3 u = positions[i + 1] - positions[i];
            const glm::vec3 v = positions[i + 2] - positions[i];
            lumel.area += 0.5f * glm::length(glm::cross(u, v));
            made.lumels.pieces.push_back(
                {positions[i], u, v, glm::normalize(glm::cross(u, v)), lumel.area, 0});
        }
        for (std::size_t i = lumel.first_piece; i < made.lumels.pieces.size(); ++i)
            made.lumels.pieces[i].share /= lumel.area;
        lumel.position = 0.95f * glm::normalize(a + b + c);
        lumel.normal = -glm::normalize(a + b + c);
        made.lumels.lumels.push_back(lumel);

        Material material;
        material.base_color = glm::vec4(lumel.albedo, 1.0f);
        material.emitted = lumel.emission / support::kPi;
        support::add_mesh(made.scene, positions, indices, material);
    }
    return made;
}

void expect_even_light(const support::HandMade& made)
{
    const RayScene rays(made.scene);
    ReferenceOptions options;
    options.samples_per_lumel = 4096;
    const auto irradiance = reference_irradiance(made.scene, rays, made.lumels, options);

    glm::dvec3 emission(0.0), albedo(0.0);
    double area = 0.0;
    for (const Lumel& lumel : made.lumels.lumels) {
        emission += glm::dvec3(lumel.emission) * double(lumel.area);
        albedo += glm::dvec3(lumel.albedo) * double(lumel.area);
        area += lumel.area;
    }
    for (int c = 0; c < 3; ++c) {
        const double truth = furnace_irradiance(emission[c] / area, albedo[c] / area);
        for (std::size_t i = 0; i < irradiance.size(); ++i)
            EXPECT_NEAR(irradiance[i][c] / truth, 1.0, 0.03) << "face " << i << ", channel " << c;
    }
}

TEST(Sphere, APatchworkIsLitEvenly)
{
    expect_even_light(patchwork_sphere(12));
}

TEST(Sphere, AMirroredPatchworkWithSmoothNormalsIsLitEvenly)
{
    support::HandMade made = patchwork_sphere(12);
    for (Instance& instance : made.scene.instances)
        instance.transform = glm::scale(glm::mat4(1.0f), {1.0f, -1.0f, 1.0f});
    for (Mesh& mesh : made.scene.meshes)
        for (const glm::vec3& position : mesh.primitives[0].positions)
            mesh.primitives[0].normals.push_back(-position);
    expect_even_light(made);
}

}  // namespace
}  // namespace lumel
