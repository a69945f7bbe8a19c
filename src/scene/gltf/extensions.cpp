#include "scene/gltf/extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace lumel {

namespace {

/// Extensions that are read or do not affect diffuse light; files may require them.
constexpr std::array<std::string_view, 28> kSupported = {
    "EXT_lights_area",
    "EXT_lights_ies",
    "EXT_lights_image_based",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_transform",
    "KHR_materials_emissive_strength",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_animation_pointer",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MOZ_lightmap",
};

}  // namespace

void check_extensions(const JsonView& root)
{
    root.each("extensionsUsed", [](const JsonView& name, std::size_t) { name.string(); });
    root.each("extensionsRequired", [](const JsonView& name, std::size_t) {
        if (std::find(kSupported.begin(), kSupported.end(), name.string()) == kSupported.end())
            refuse_extension(name, quoted(name.string()));
    });
}

void refuse_extension(const JsonView& place, const std::string& name)
{
    place.fail("needs the extension " + name +
               ", which is not supported; export the scene without it");
}

void erase_extension(Json& object, const char* name)
{
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object())
        return;
    extensions->erase(name);
    if (extensions->empty())
        object.erase("extensions");
}

void forget_extension(Json& gltf, const char* name)
{
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        const auto names = gltf.find(key);
        if (names == gltf.end())
            continue;
        names->erase(std::remove(names->begin(), names->end(), name), names->end());
        if (names->empty())
            gltf.erase(key);
    }
}

bool uses_extension(const JsonView& root, const char* name)
{
    const auto used = root.find("extensionsUsed");
    if (!used)
        return false;
    const Json& names = used->as_array().json();
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace lumel
