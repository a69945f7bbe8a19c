#pragma once
// A scene made ready: rays, surfaces, atlas and lumels, the inputs of every method.

#include <functional>
#include <memory>
#include <string>

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "rays/paths/surfaces.h"
#include "scene/sky/light_options.h"

namespace lumel {

/// Reads a scene and adds the lights of the options. Throws Error.
Scene read_scene(const std::string& path, MaterialModel model, const LightOptions& lights);

/// Adds a warning if nothing in the scene gives light.
void warn_if_dark(Scene& scene);

/// Throws Error{input} if the scene has no such camera; -1 means any.
void check_camera(const Scene& scene, int camera);

/// A scene with its lumels; buried ones are marked. Must not move, because rays and surfaces refer
/// to the scene.
struct SolveScene {
    /// Builds the atlas and the lumels of a scene. Throws Error.
    SolveScene(Scene scene, const AtlasOptions& options, const ProgressCallback& progress = {});
    /// Uses the atlas that `lay_out` makes, and `bury`, whose result is `open`, instead of
    /// mark_buried.
    using LayOut = std::function<Atlas(const Scene&, const RayScene&, const ProgressCallback&)>;
    using Bury = std::function<std::vector<float>(const Scene&, const RayScene&, const Atlas&,
                                                  Lumels&, const ProgressCallback&)>;
    SolveScene(Scene scene, const LayOut& lay_out, const Bury& bury = {},
               const ProgressCallback& progress = {});
    /// Uses an atlas and lumels of the scene. movers: instances that may move; `rays` omits them.
    SolveScene(Scene scene, Atlas atlas, Lumels lumels, std::vector<std::uint32_t> movers = {});
    /// Reads the scene first.
    SolveScene(const std::string& scene_path, const AtlasOptions& options);
    SolveScene(const SolveScene&) = delete;
    SolveScene& operator=(const SolveScene&) = delete;

    /// Diagonal of the scene's bounding box [m].
    float extent() const { return glm::distance(rays.low(), rays.high()); }
    /// Corners of its bounding box in the world of its file [m].
    glm::dvec3 low_in_file() const { return glm::dvec3(rays.low()) + scene.origin; }
    glm::dvec3 high_in_file() const { return glm::dvec3(rays.high()) + scene.origin; }

    Scene scene;
    std::vector<std::uint32_t> movers;  ///< instances, ascending
    RayScene rays;                      ///< of all others
    Surfaces surfaces;
    Atlas atlas;
    Lumels lumels;
    std::vector<float> open;  ///< [N] share of each lumel's area that is not buried
};

/// Builds the atlas and lumels of a scene in which instances `movers` may move. Static geometry
/// buries static lumels. Throws Error.
std::unique_ptr<SolveScene> lay_out_movers(Scene scene, const AtlasOptions& options,
                                           const std::vector<std::uint32_t>& movers);

/// A separate copy, with rays of its own.
std::unique_ptr<SolveScene> copy_of(const SolveScene& scene);

}  // namespace lumel
