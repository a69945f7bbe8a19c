#pragma once
// Directional light as layers of lightmap.exr. docs/directional.md describes them.

#include <map>
#include <string>
#include <vector>

#include "atlas/finish/finish.h"
#include "atlas/prepare/solve_scene.h"
#include "base/images/image_files.h"

namespace lumel {

/// A finished lightmap with its layers sh.0, sh.1, …
struct DirectionalMaps {
    Image light;
    std::vector<Layer> layers;
};

/// irradiance [N] [lx], coefficients [4 or 9][N] [cd/m²]. At every covered texel the layers
/// reproduce the irradiance of the map for the shading normal of the lumel there.
DirectionalMaps finish_directional(const SolveScene& prepared,
                                   const std::vector<glm::vec3>& irradiance,
                                   const std::vector<std::vector<glm::vec3>>& coefficients);

/// Description of the layers for the file.
std::map<std::string, std::string> directional_metadata();

}  // namespace lumel
