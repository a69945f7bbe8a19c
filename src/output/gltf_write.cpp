#include "output/gltf_write.h"

#include <algorithm>
#include <vector>

#include "core/files.h"
#include "images/image_files.h"
#include "output/baked_materials.h"
#include "output/baked_meshes.h"
#include "output/glb_builder.h"
#include "scene/baked_lights.h"

namespace lumel {
namespace {

// Light beyond this multiple of the bright end is shown white by any sensible exposure; storing
// it would take the few bits of the PNG away from everything else.
constexpr float kLargestOverBright = 2.0f;

// Irradiance of a white texel.
float lightmap_scale(const Image& map)
{
    float brightest = 0.0f;
    for (std::size_t i = 0; i < map.values.size(); i += 4)
        if (map.values[i + 3] > 0.0f)
            brightest = std::max({brightest, map.values[i], map.values[i + 1], map.values[i + 2]});
    if (!(brightest > 0.0f))
        return 1.0f;
    return std::min(brightest, kLargestOverBright * bright_end(map));
}

// RGB only, multiplied by `scale`: coverage means nothing to a viewer.
Image without_alpha(const Image& map, float scale)
{
    Image rgb(map.width, map.height, 3);
    for (std::size_t texel = 0; texel < rgb.values.size() / 3; ++texel)
        for (std::size_t c = 0; c < 3; ++c)
            rgb.values[texel * 3 + c] = map.values[texel * 4 + c] * scale;
    return rgb;
}

// In asset.extras: what a viewer should know of the light that is baked.
void tell_of_lights(Json& gltf, const SceneLights& lights)
{
    Json told = {{"lightmapUnit", "lx"}};
    if (lights.exposure)
        told["exposure"] = *lights.exposure;
    told["bakedLights"] = lights.keep ? 0 : put_away_lights(gltf);
    Json& extras = gltf["asset"]["extras"];
    if (!extras.is_null() && !extras.is_object())
        extras = Json{{"value", std::move(extras)}};
    extras["lumel"] = std::move(told);
}

void write(const std::string& path, GlbBuilder& builder)
{
    list_extensions(builder.json, builder.document().json);
    const std::vector<std::uint8_t> file = builder.finish();
    write_bytes(path, std::as_bytes(std::span(file)));
}

}  // namespace

void write_scene_glb(const std::string& path, const Scene& scene, const Atlas& atlas,
                     const Image& map, const SceneLights& lights)
{
    const GltfDocument document = load_gltf_document(scene.path);
    GlbBuilder builder(document);
    std::vector<BakedPrimitive> baked = list_baked_primitives(document, scene, atlas);

    cut_baked_primitives(builder.json, baked);
    const std::vector<std::size_t> materials = separate_materials(builder.json, baked);
    if (const auto old = outdated_lightmap(builder.json, document.json))
        builder.retire_texture(*old);
    builder.release();
    tell_of_lights(builder.json, lights);  // what they refer to is no longer seen from now on

    const float scale = lightmap_scale(map);
    const std::vector<unsigned char> png =
        encode_png(without_alpha(map, 1.0f / scale), PngEncoding::linear);
    place_baked_primitives(builder, baked, atlas);
    bind_lightmap(builder.json, materials, builder.add_texture("lightmap", png), scale);
    write(path, builder);
}

void write_baked_glb(const std::string& path, const Scene& scene, const Atlas& atlas,
                     const Image& radiance)
{
    const GltfDocument document = load_gltf_document(scene.path);
    GlbBuilder builder(document);
    std::vector<BakedPrimitive> baked = list_baked_primitives(document, scene, atlas);

    cut_baked_primitives(builder.json, baked);
    const std::vector<std::size_t> materials = separate_materials(builder.json, baked);
    reduce_to_core(builder.json, materials);
    builder.release();

    const std::vector<unsigned char> png = encode_png(without_alpha(tone_map(radiance), 1.0f));
    place_baked_primitives(builder, baked, atlas);
    erase_extensions(builder.json);
    bind_emission(builder.json, materials, builder.add_texture("baked light", png));
    write(path, builder);
}

}  // namespace lumel
