#pragma once
// Light probe positions defined by a file.

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

struct ProbePlace {
    std::string name;          ///< node name, may be empty
    glm::dvec3 position{0.0};  ///< world space of the file [m]
};

/// Origins of the default scene's nodes with extras.lumel.probe, in file order. Throws Error{input}
/// as read_gltf does.
std::vector<ProbePlace> probe_places(const std::string& path);

}  // namespace lumel
