#include "bench/papers/landscape.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/values/scene_hash.h"

namespace lumel::bench {
namespace {

constexpr float kSide = 20.0f;  ///< [m]

/// A train of hills. Each is smaller and runs in another direction than the one before.
struct RayBatch {
    glm::vec2 per_metre;  ///< [rad / m]
    float height, phase;  ///< [m], [rad]
};

constexpr RayBatch kWaves[] = {{{0.31f, 0.22f}, 1.1f, 0.4f},   {{-0.27f, 0.53f}, 0.8f, 2.1f},
                               {{0.83f, -0.41f}, 0.45f, 1.3f}, {{0.62f, 1.17f}, 0.3f, 5.2f},
                               {{-1.71f, 0.88f}, 0.16f, 3.3f}, {{1.27f, 2.31f}, 0.1f, 0.9f},
                               {{3.47f, -1.13f}, 0.06f, 4.4f}, {{-2.2f, -4.1f}, 0.04f, 1.8f}};

/// Height [m], and its slopes along x and z.
glm::vec3 ground_at(const glm::vec2& at)
{
    glm::vec3 ground(0.0f);
    for (const RayBatch& wave : kWaves) {
        const float angle = glm::dot(wave.per_metre, at) + wave.phase;
        ground += wave.height * glm::vec3(std::sin(angle), wave.per_metre * std::cos(angle));
    }
    return ground;
}

Primitive hills(int cells)
{
    Primitive primitive;
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) {
            const glm::vec2 at = kSide * (glm::vec2(column, row) / float(cells) - glm::vec2(0.5f));
            const glm::vec3 ground = ground_at(at);
            primitive.positions.emplace_back(at.x, ground.x, at.y);
            primitive.normals.push_back(glm::normalize(glm::vec3(-ground.y, 1.0f, -ground.z)));
        }
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            const auto a = std::uint32_t(row * (cells + 1) + column);
            const std::uint32_t b = a + std::uint32_t(cells) + 1;
            primitive.indices.insert(primitive.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    return primitive;
}

}  // namespace

Scene landscape(int cells)
{
    Scene scene;
    scene.path = "landscape";
    Material grass{.name = "grass"};
    grass.base_color = glm::vec4(0.45f, 0.5f, 0.25f, 1.0f);
    scene.materials = {grass};
    scene.meshes = {{"hills", {hills(cells)}}};
    scene.instances = {{.name = "hills"}};
    const glm::vec3 eye(9.5f, 7.0f, 12.0f), target(0.5f, 0.0f, 0.0f), up(0.0f, 1.0f, 0.0f);
    Camera camera{.name = "camera"};
    camera.transform = glm::inverse(glm::lookAt(eye, target, up));
    scene.cameras = {camera};
    scene.hash = hash_scene(scene);
    return scene;
}

}  // namespace lumel::bench
