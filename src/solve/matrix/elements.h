#pragma once
// What is known of the patches behind the rows and columns of a matrix.

#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// All [n].
struct Elements {
    std::vector<glm::vec3> color;   ///< albedo: what F^c has multiplied its columns by
    std::vector<float> area;        ///< > 0, in any unit
    std::vector<glm::vec3> place;   ///< in any unit
    std::vector<glm::vec3> normal;  ///< unit
};

}  // namespace lumel
