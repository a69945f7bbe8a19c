#include "bake/prepare.h"

#include "nearfield/buried.h"

namespace lumel {

Prepared prepare(const std::string& scene_path, const AtlasOptions& options)
{
    return prepare(read_gltf(scene_path), options);
}

Prepared prepare(Scene scene, const AtlasOptions& options)
{
    Atlas atlas = make_atlas(scene, options);
    Lumels lumels = lift(scene, atlas);
    RayScene rays(scene);
    mark_buried(scene, rays, lumels);
    return {std::move(scene), std::move(atlas), std::move(lumels), std::move(rays)};
}

}  // namespace lumel
