#pragma once
// A closed room whose walls are a single sheet each, with a closed block on its floor.

#include "../support/box_lumels.h"
#include "../support/lamps.h"

namespace lumel::test {

inline constexpr float kBulb = 50.0f;  // [cd]

/// double_sided: as Blender writes all materials.
inline Scene paper_house(bool double_sided)
{
    Scene scene;
    const support::Quad look{.albedo = glm::vec3(0.7f)};
    for (const support::Quad& wall : support::box_walls({0, 0, 0}, {4, 3, 4}, true, look))
        support::add_quad(scene, wall);
    for (const support::Quad& face :
         support::box_walls({1.0f, 0.0f, 1.0f}, {1.8f, 0.9f, 1.8f}, false, look))
        support::add_quad(scene, face);
    for (Material& material : scene.materials)
        material.double_sided = double_sided;
    for (Mesh& mesh : scene.meshes)
        for (Primitive& primitive : mesh.primitives)
            primitive.texcoords[1].clear();
    return scene;
}

inline void add_bulb(Scene& scene)
{
    scene.lights.push_back(
        support::make_lamp(PunctualLight::Kind::point, kBulb, {3.0f, 2.0f, 3.0f}, {0, -1, 0}));
}

}  // namespace lumel::test
