#pragma once
// The box of the thesis' scenes, moved, and the light of its scene.

#include <cmath>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "atlas/near/still_part.h"
#include "methods/redistribution/live_scene.h"
#include "scene/values/scene.h"

namespace lumel::test {

/// The box's place, shifted toward a wall [m] and turned about its own axis [rad].
inline glm::mat4 shifted(const Scene& scene, float distance, float angle)
{
    const glm::vec3 axis(1.0f, 0.0f, 1.0f);
    const glm::mat4 shift =
        glm::translate(glm::mat4(1.0f), axis + glm::vec3(-distance, 0.0f, 0.0f));
    return glm::translate(glm::rotate(shift, angle, glm::vec3(0, 1, 0)), -axis) *
           scene.instances[find_instance(scene, "box")].transform;
}

/// The box's place once it has turned about the upright axis through its middle [rad].
inline glm::mat4 turned_box(const Scene& scene, float angle)
{
    const std::uint32_t box = find_instance(scene, "box");
    const glm::mat4& place = scene.instances[box].transform;
    const MovedBox bounds = box_of(scene, box, place);
    const glm::vec3 centre = 0.5f * (bounds.low + bounds.high);
    const glm::mat4 turn =
        glm::rotate(glm::translate(glm::mat4(1.0f), centre), angle, glm::vec3(0, 1, 0));
    return glm::translate(turn, -centre) * place;
}

/// Relative RMSE over lumels with none of the flags `left_out`.
inline double apart(const LiveScene& scene, const std::vector<glm::vec3>& values,
                    const std::vector<glm::vec3>& truth, std::uint32_t left_out = kLumelBuried)
{
    double square = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (scene.lumels().lumels[i].flags & left_out)
            continue;
        const glm::dvec3 d = glm::dvec3(values[i]) - glm::dvec3(truth[i]);
        square += glm::dot(d, d);
        sum += double(truth[i].r) + double(truth[i].g) + double(truth[i].b);
        count += 3.0;
    }
    return std::sqrt(square / count) / (sum / count);
}

}  // namespace lumel::test
