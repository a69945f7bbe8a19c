#pragma once
// Places for light probes that a file names.

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

struct ProbePlace {
    std::string name;          ///< of its node, may be empty
    glm::dvec3 position{0.0};  ///< in the world, as the file has it [m]
};

/// Nodes of the default scene with extras.lumel.probe, in file order, at their origins. Throws
/// Error{input} as reading the scene does.
std::vector<ProbePlace> probe_places(const std::string& path);

}  // namespace lumel
