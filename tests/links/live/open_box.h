#pragma once
// The Cornell box, open to a sky with a bright part, and with a lamp in it.

#include <glm/gtc/matrix_transform.hpp>

#include "../../support/source_folder.h"
#include "scene/values/scene.h"

namespace lumel::test {

inline Scene open_box()
{
    Scene scene = read_gltf(support::source_path("scenes/cornell-box.gltf"));
    scene.sky = {
        .width = 16, .height = 8, .radiance = std::vector<glm::vec3>(128, glm::vec3(2.0f))};
    scene.sky.radiance[3 * 16 + 4] = glm::vec3(3000.0f, 2000.0f, 1000.0f);  // low in the open side
    PunctualLight lamp{.name = "lamp", .intensity = 20.0f, .radius = 0.02f};
    lamp.transform = glm::translate(glm::mat4(1.0f), glm::vec3(0.15f, 0.4f, 0.3f));
    scene.lights.push_back(lamp);
    return scene;
}

inline Scene open_box_in_the_sun()
{
    constexpr float kAway = 3.14159265358979f - 0.5f;  // from where a light shines unturned
    Scene scene = open_box();
    PunctualLight sun{.kind = PunctualLight::Kind::directional, .name = "sun", .intensity = 300.0f};
    sun.angle = 0.02f;
    sun.transform = glm::rotate(glm::mat4(1.0f), kAway, glm::vec3(0.8f, -0.6f, 0.0f));
    scene.lights.push_back(sun);
    return scene;
}

}  // namespace lumel::test
