#include "bake/prepare.h"

#include "nearfield/buried.h"

namespace lumel {

Prepared::Prepared(Scene given, const AtlasOptions& options)
    : scene(std::move(given)),
      rays(scene),
      atlas(make_atlas(scene, options)),
      lumels(lift(scene, atlas))
{
    mark_buried(scene, rays, lumels);
}

Prepared::Prepared(const std::string& scene_path, const AtlasOptions& options)
    : Prepared(read_gltf(scene_path), options)
{
}

}  // namespace lumel
