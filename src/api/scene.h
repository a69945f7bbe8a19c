#pragma once

#include <memory>

#include "lumel/lumel.h"
#include "scene/gltf/document.h"
#include "scene/values/scene.h"

namespace lumel::v0 {

struct SceneImpl {
    lumel::Scene scene;
    /// The scene's file as it was read; null for a scene made in memory.
    std::shared_ptr<const GltfDocument> document;
};

/// Checks and converts. Throws lumel::Error{input} with the location of the fault.
lumel::Scene scene_of(const SceneContent& content);

}  // namespace lumel::v0
