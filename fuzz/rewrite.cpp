// A scene is read and written again with a lightmap, as at the end of a bake.

#include "../tests/results/files/hand_atlas.h"
#include "memory_file.h"
#include "results/files/gltf_write.h"

namespace lumel::fuzz {
namespace {

constexpr std::size_t kMaxCorners = 3000;  // what takes longer finds no more

std::size_t corners_of(const Scene& scene)
{
    std::size_t corners = 0;
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            corners += primitive.indices.size();
    return corners;
}

}  // namespace

void rewrite_glb(Input input)
{
    const MemoryFile file(input), written({});
    const GltfDocument document = load_gltf_document(file.path());
    const Scene scene = read_gltf(file.path());
    if (corners_of(scene) > kMaxCorners)
        return;
    Atlas atlas = test::corner_atlas(scene, 16);
    atlas.back_shift.assign(atlas.chart_count, glm::ivec2(1, 2));
    const Image map = test::any_map(atlas);
    write_baked_glb(written.path(), document, scene, atlas, map);
    read_gltf(written.path());
    write_scene_glb(written.path(), document, scene, atlas, map, {});
    // What was baked can be baked again.
    const Scene again = read_gltf(written.path());
    const MemoryFile twice({});
    atlas = test::corner_atlas(again, 16);
    write_scene_glb(twice.path(), load_gltf_document(written.path()), again, atlas,
                    test::any_map(atlas));
}

}  // namespace lumel::fuzz
