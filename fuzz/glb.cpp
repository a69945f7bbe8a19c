#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/core/error.h"
#include "memory_file.h"
#include "scene/load/probe_places.h"
#include "scene/values/animation.h"
#include "scene/values/scene.h"

namespace lumel::fuzz {
namespace {

bool is_finite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check(const Primitive& primitive, const Scene& scene)
{
    const std::size_t count = primitive.positions.size();
    require(std::size_t(primitive.material) < scene.materials.size(), "a material is there");
    for (const std::size_t length : {primitive.normals.size(), primitive.colors.size(),
                                     primitive.texcoords[0].size(), primitive.texcoords[1].size(),
                                     primitive.texcoords[2].size(), primitive.texcoords[3].size()})
        require(length == 0 || length == count, "attributes have an element for each vertex");
    for (const glm::vec3& position : primitive.positions)
        require(is_finite(position), "positions are finite");
    for (const std::uint32_t index : primitive.indices)
        require(index < count, "indices have a vertex");
}

void check(const Scene& scene)
{
    for (const Instance& instance : scene.instances) {
        require(std::size_t(instance.mesh) < scene.meshes.size(), "a mesh is there");
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            check(primitive, scene);
    }
    for (const Material& material : scene.materials)
        for (const TextureUse* use : {&material.base_color_texture, &material.emissive_texture})
            require(use->texture < int(scene.textures.size()), "a texture is there");
}

}  // namespace

void read_glb(Input input)
{
    const MemoryFile file(input);
    Scene scene = read_gltf(file.path());
    check(scene);
    probe_places(file.path());
    constexpr std::string_view kAnimations = "animations";
    if (std::search(input.begin(), input.end(), kAnimations.begin(), kAnimations.end()) ==
        input.end())
        return;
    const Animation animation = read_animation(file.path());
    for (const double time : {-1.0, 0.0, 0.5, animation.duration}) {
        pose(scene, animation, time);
        check(scene);
    }
}

}  // namespace lumel::fuzz
