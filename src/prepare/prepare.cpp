#include "prepare/prepare.h"

#include "core/error.h"
#include "nearfield/buried.h"

namespace lumel {

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

Prepared::Prepared(Scene given, const AtlasOptions& options)
    : Prepared(std::move(given), [&](const Scene& placed) { return make_atlas(placed, options); })
{
}

Prepared::Prepared(Scene given, const LayOut& lay_out, const Bury& bury)
    : scene(std::move(given)),
      rays(scene),
      atlas(lay_out(scene)),
      lumels(lift(scene, atlas))
{
    if (lumels.lumels.empty())
        throw Error(ErrorKind::input, scene.path,
                    "has no surface that light could fall on: nothing is drawn, or all of it is "
                    "cut out");
    open = bury ? bury(scene, rays, lumels) : mark_buried(scene, rays, lumels);
}

Prepared::Prepared(const std::string& scene_path, const AtlasOptions& options)
    : Prepared(read_gltf(scene_path), options)
{
}

}  // namespace lumel
