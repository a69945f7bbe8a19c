#include "prepare/prepare.h"

#include "core/error.h"
#include "nearfield/buried.h"
#include "prepare/lit_sides.h"

namespace lumel {
namespace {

/// How far the work is, roughly, when its parts end.
constexpr double kRaysReady = 0.1, kLaidOut = 0.3, kLifted = 0.5;

}  // namespace

Scene read_scene(const std::string& path, MaterialModel model, const LightOptions& lights)
{
    Scene scene = read_gltf(path, model);
    add_lights(scene, lights);
    return scene;
}

void check_camera(const Scene& scene, int camera)
{
    const int cameras = int(scene.cameras.size());
    if (camera >= cameras)
        throw Error(ErrorKind::input, "--camera " + std::to_string(camera),
                    cameras == 0 ? "the scene has no cameras; leave it out and one is chosen"
                                 : "the scene's cameras are 0 to " + std::to_string(cameras - 1));
}

Prepared::Prepared(Scene given, const AtlasOptions& options, const Watch& watch)
    : Prepared(
          std::move(given),
          [&](const Scene& placed, const RayScene& among, const Watch& part) {
              return make_atlas(placed, options, part, shows_both(options.sides, among));
          },
          {}, watch)
{
}

Prepared::Prepared(Scene given, const LayOut& lay_out, const Bury& bury, const Watch& watch)
    : scene(std::move(given)),
      rays(scene),
      atlas(lay_out(scene, rays, part_of(watch, kRaysReady, kLaidOut))),
      lumels(lift(scene, atlas, part_of(watch, kLaidOut, kLifted)))
{
    if (lumels.lumels.empty())
        throw Error(ErrorKind::input, scene.path,
                    "has no surface that light could fall on: nothing is drawn, or all of it is "
                    "cut out");
    open = bury ? bury(scene, rays, lumels)
                : mark_buried(scene, rays, lumels, {}, part_of(watch, kLifted, 1.0));
}

Prepared::Prepared(const std::string& scene_path, const AtlasOptions& options)
    : Prepared(read_gltf(scene_path), options)
{
}

}  // namespace lumel
