#pragma once
// What every method needs before it can begin.

#include <string>

#include "atlas/atlas.h"
#include "rays/ray_scene.h"
#include "scene/scene.h"

namespace lumel {

/// A scene with its lumels; buried ones are marked.
struct Prepared {
    Scene scene;
    Atlas atlas;
    Lumels lumels;
    RayScene rays;
};

/// Reads, lays out and lifts a scene. Throws Error.
Prepared prepare(const std::string& scene_path, const AtlasOptions& options);

/// The same for a scene already in memory.
Prepared prepare(Scene scene, const AtlasOptions& options);

}  // namespace lumel
