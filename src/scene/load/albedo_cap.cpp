#include "scene/load/albedo_cap.h"

#include <algorithm>
#include <cmath>

#include "base/json/json_view.h"
#include "scene/values/scene_hash.h"
#include "scene/values/srgb.h"

namespace lumel {
namespace {

/// Maximum number of materials that the warning names.
constexpr std::size_t kMaxNames = 12;

float brightest(const glm::vec3& color)
{
    return std::max({color.r, color.g, color.b});
}

/// Mean colour of a texture. by_alpha: transparent texels do not count.
glm::vec3 mean_color(const Texture& texture, bool by_alpha)
{
    const auto& linear = srgb_to_linear();
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    for (std::size_t i = 0; i + 3 < texture.rgba.size(); i += 4) {
        const std::uint8_t* rgba = &texture.rgba[i];
        const double own = by_alpha ? double(rgba[3]) : 1.0;
        sum += own * glm::dvec3(linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]);
        weight += own;
    }
    return weight > 0.0 ? glm::vec3(sum / weight) : glm::vec3(0.0f);
}

/// Mean reflectance of a material, without vertex colours.
glm::vec3 mean_albedo(const Scene& scene, const Material& material)
{
    const int texture = material.base_color_texture.texture;
    if (texture < 0)
        return glm::vec3(material.base_color);
    return glm::vec3(material.base_color) * mean_color(scene.textures[std::size_t(texture)],
                                                       material.alpha_mode != AlphaMode::opaque);
}

/// [materials] 1 for materials of instances.
std::vector<char> used_materials(const Scene& scene)
{
    std::vector<char> used(scene.materials.size(), 0);
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[std::size_t(instance.mesh)].primitives)
            used[std::size_t(primitive.material)] = 1;
    return used;
}

/// "\"a\", \"b\" and 3 more" for materials that are brighter than the limit, "" for none.
std::string too_bright(const Scene& scene)
{
    const std::vector<char> used = used_materials(scene);
    std::string names;
    std::size_t count = 0;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const Material& material = scene.materials[m];
        const float reflects = 1.0f - material.transmission;
        if (!used[m] || reflects * brightest(glm::vec3(material.base_color)) <= scene.max_albedo ||
            reflects * brightest(mean_albedo(scene, material)) <= scene.max_albedo)
            continue;
        if (++count <= kMaxNames)
            names += (names.empty() ? "" : ", ") + quoted(material.name);
    }
    return count > kMaxNames ? names + " and " + std::to_string(count - kMaxNames) + " more"
                             : names;
}

}  // namespace

void cap_albedo(Scene& scene, float most)
{
    if (scene.max_albedo != most) {
        scene.max_albedo = most;
        scene.hash = hash_scene(scene);
    }
    const std::string names = too_bright(scene);
    if (names.empty())
        return;
    const std::string percent = std::to_string(std::lround(100.0f * most));
    const std::string warning = "materials reflect more than " + percent +
                                " % of the light and are taken to reflect " + percent +
                                " % (--max-albedo): " + names;
    if (std::find(scene.warnings.begin(), scene.warnings.end(), warning) == scene.warnings.end())
        scene.warnings.push_back(warning);
}

}  // namespace lumel
