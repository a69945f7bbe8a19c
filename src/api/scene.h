#pragma once

#include "lumel/lumel.h"
#include "scene/values/scene.h"

namespace lumel::v0 {

struct SceneImpl {
    lumel::Scene scene;
    bool is_of_file;  ///< read from a file
};

/// Checks and converts. Throws lumel::Error{input} with the location of the fault.
lumel::Scene scene_of(const SceneContent& content);

}  // namespace lumel::v0
