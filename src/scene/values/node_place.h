#pragma once
// Transform of a node relative to its parent.

#include <optional>

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace lumel {

/// Scale, then rotation, then translation [m]; or a matrix.
struct NodePlace {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    std::optional<glm::dmat4> matrix;  ///< replaces the others if set
};

inline glm::dmat4 to_matrix(const NodePlace& place)
{
    if (place.matrix)
        return *place.matrix;
    return glm::translate(glm::dmat4(1.0), place.translation) * glm::mat4_cast(place.rotation) *
           glm::scale(glm::dmat4(1.0), place.scale);
}

}  // namespace lumel
