#include "bake/grain.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace lumel {
namespace {

/// A texture at this many times the density of the lightmap looks blurred.
constexpr double kVisible = 1.5;

/// Texels of a texture that lie on a primitive, and the area under them [m²].
struct Spread {
    double texels = 0.0, area = 0.0;
};

Spread spread_over(const Scene& scene, const Primitive& primitive, const glm::mat4& to_world,
                   const TextureUse& use)
{
    const Texture& texture = scene.textures[std::size_t(use.texture)];
    const std::vector<glm::vec2>& texcoords = primitive.texcoords[use.texcoord];
    Spread spread;
    if (texcoords.empty())
        return spread;
    for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
        glm::vec3 place[3], texel[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t v = primitive.indices[t + k];
            place[k] = glm::vec3(to_world * glm::vec4(primitive.positions[v], 1.0f));
            texel[k] = use.transform * glm::vec3(texcoords[v], 1.0f);
            texel[k] *= glm::vec3(texture.width, texture.height, 0.0f);
        }
        spread.area += double(glm::length(glm::cross(place[1] - place[0], place[2] - place[0])));
        spread.texels += double(glm::length(glm::cross(texel[1] - texel[0], texel[2] - texel[0])));
    }
    return spread;
}

/// Texels per metre of each texture that is seen, where it is finest.
std::map<int, double> densities(const Scene& scene)
{
    std::map<int, double> finest;
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives) {
            const Material& material = scene.materials[std::size_t(primitive.material)];
            for (const TextureUse* use : {&material.base_color_texture, &material.emissive_texture})
                if (use->texture >= 0) {
                    const Spread spread = spread_over(scene, primitive, instance.transform, *use);
                    double& density = finest[use->texture];
                    if (spread.area > 0.0)
                        density = std::max(density, std::sqrt(spread.texels / spread.area));
                }
        }
    return finest;
}

}  // namespace

std::string lost_grain(const Scene& scene, const Atlas& atlas)
{
    const std::map<int, double> finest = densities(scene);
    std::size_t coarser = 0;
    double most = 0.0;
    for (const auto& [texture, density] : finest) {
        const double ratio = density / double(atlas.texels_per_metre);
        coarser += ratio > kVisible ? 1 : 0;
        most = std::max(most, ratio);
    }
    if (coarser == 0)
        return {};
    return fmt::format("scene-baked.glb shows {} of {} textures more coarsely than they are, up to "
                       "{:.2g} times: it has the lightmap's {:.3g} texels per metre; scene.glb "
                       "keeps them",
                       coarser, finest.size(), most, atlas.texels_per_metre);
}

}  // namespace lumel
