#pragma once
// Scene, rays, atlas and lumels: the inputs of every method.

#include <functional>
#include <string>

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "scene/sky/light_options.h"

namespace lumel {

/// Reads a scene and adds the lights of the options. Throws Error.
Scene read_scene(const std::string& path, MaterialModel model, const LightOptions& lights);

/// Throws Error{input} if the scene has no such camera; -1 means any.
void check_camera(const Scene& scene, int camera);

/// A scene with its lumels; buried ones are marked. Not movable, because the rays refer to the
/// scene.
struct Prepared {
    /// Builds the atlas and the lumels of a scene. Throws Error.
    Prepared(Scene scene, const AtlasOptions& options, const ProgressCallback& progress = {});
    /// Uses the atlas that `lay_out` makes, and `bury`, whose result is `open`, instead of
    /// mark_buried.
    using LayOut = std::function<Atlas(const Scene&, const RayScene&, const ProgressCallback&)>;
    using Bury = std::function<std::vector<float>(const Scene&, const RayScene&, Lumels&)>;
    Prepared(Scene scene, const LayOut& lay_out, const Bury& bury = {},
             const ProgressCallback& progress = {});
    /// Reads the scene first.
    Prepared(const std::string& scene_path, const AtlasOptions& options);
    Prepared(const Prepared&) = delete;
    Prepared& operator=(const Prepared&) = delete;

    Scene scene;
    RayScene rays;
    Atlas atlas;
    Lumels lumels;
    std::vector<float> open;  ///< [N] share of each lumel's area that is not buried
};

}  // namespace lumel
