#include "results/files/gltf_write.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/images/image_files.h"
#include "results/files/baked_materials.h"
#include "results/files/baked_meshes.h"
#include "results/files/glb_builder.h"
#include "results/files/root_node.h"
#include "scene/gltf/baked_lights.h"
#include "scene/gltf/extras.h"

namespace lumel {
namespace {

// PNG clips where exposure × irradiance exceeds this: a white surface has display code 0.94 there.
// A larger range would reduce the precision of everything else.
constexpr float kLargestExposed = 4.0f;
// Half floats and shared exponents keep all digits down to 2^-14: with at most this multiple of the
// 99.9th percentile as the unit, a ten-thousandth of the percentile is off by 0.3 % at most.
constexpr float kLargestOverHigh = 8.0f;
constexpr double kHigh = 0.999;
// Largest value that they store.
constexpr float kLargestFloat = 65000.0f;

// Range of depths of an added camera, relative to the scene's diagonal.
constexpr float kNearest = 1e-3f, kFarthest = 10.0f;

// Irradiance of a white texel.
float lightmap_scale(const Image& map, std::optional<float> exposure)
{
    std::vector<float> lit;
    for (std::size_t i = 0; i < map.values.size(); i += 4)
        if (map.values[i + 3] > 0.0f)
            lit.push_back(std::max({map.values[i], map.values[i + 1], map.values[i + 2], 0.0f}));
    const float brightest = lit.empty() ? 0.0f : *std::max_element(lit.begin(), lit.end());
    if (!(brightest > 0.0f))
        return 1.0f;
    const auto high = lit.begin() + std::ptrdiff_t(kHigh * double(lit.size() - 1));
    std::nth_element(lit.begin(), high, lit.end());
    float scale = brightest;
    if (const auto exposed = exposure ? exposure : choose_exposure(map); exposed && *exposed > 0.0f)
        scale = std::min(scale, kLargestExposed / *exposed);
    if (*high > 0.0f)
        scale = std::min(scale, kLargestOverHigh * *high);
    return std::max(scale, brightest / kLargestFloat);
}

// RGB only, multiplied by `scale`: viewers do not use coverage.
Image without_alpha(const Image& map, float scale)
{
    Image rgb(map.width, map.height, 3);
    for (std::size_t texel = 0; texel < rgb.values.size() / 3; ++texel)
        for (std::size_t c = 0; c < 3; ++c)
            rgb.values[texel * 3 + c] = map.values[texel * 4 + c] * scale;
    return rgb;
}

// Writes properties of the baked light to asset.extras.
void tell_of_lights(Json& gltf, const SceneLighting& lights)
{
    Json told = {{"lightmapUnit", "lx"}};
    if (lights.exposure)
        told["exposure"] = *lights.exposure;
    told["bakedLights"] = lights.keep ? 0 : put_away_lights(gltf);
    extras_of(gltf["asset"])["lumel"] = std::move(told);
}

/// Adds the camera to the default scene. origin: Scene::origin.
void add_camera(Json& gltf, const AddedCamera& camera, const glm::dvec3& origin)
{
    const View& view = camera.view;
    gltf["cameras"].push_back({{"type", "perspective"},
                               {"perspective",
                                {{"yfov", view.vertical_fov},
                                 {"aspectRatio", view.aspect},
                                 {"znear", kNearest * camera.extent},
                                 {"zfar", kFarthest * camera.extent}}}});
    glm::dmat4 place(view.transform);
    place[3] += glm::dvec4(origin, 0.0);
    add_root(gltf, {{"name", "preview"}, {"camera", gltf["cameras"].size() - 1}}, place);
}

std::size_t add_lightmap(GlbBuilder& builder, const Image& map, float scale,
                         const std::string& name, LightmapFormat format)
{
    const Image texels = without_alpha(map, 1.0f / scale);
    std::vector<unsigned char> ktx2;
    if (format == LightmapFormat::ktx2)
        ktx2 = encode_ktx2(texels, FloatTexel::half);
    if (format == LightmapFormat::rgb9e5)
        ktx2 = encode_ktx2(texels, FloatTexel::shared_exponent);
    return builder.add_texture(name, encode_png(texels, PngEncoding::linear), ktx2);
}

/// Rewrites the scene's file with separate materials for each page of the baked surfaces. `prepare`
/// edits these and releases the builder; `finish` adds the textures of the pages. Both receive the
/// builder and the materials by page.
template <class Prepare, class Finish>
void rewrite(const std::string& path, const GltfDocument& document, const Scene& scene,
             const Atlas& atlas, Attributes kept, Compression compression, const Prepare& prepare,
             const Finish& finish)
try {
    GlbBuilder builder(document);
    forget_lamps(builder.json);
    std::vector<BakedPrimitive> baked = list_baked_primitives(document, scene, atlas);

    cut_baked_primitives(builder.json, baked);
    const auto materials = separate_materials(builder.json, baked);
    prepare(builder, materials);
    place_baked_primitives(builder, baked, atlas, kept);
    finish(builder, materials);
    list_extensions(builder.json, document.json);
    const std::vector<std::uint8_t> file = builder.finish(compression);
    write_bytes(path, std::as_bytes(std::span(file)));
} catch (const Json::exception& error) {  // the reader skips such JSON, but the output needs it
    throw Error(ErrorKind::input, scene.path, std::string("cannot be rewritten: ") + error.what());
}

}  // namespace

void write_scene_glb(const std::string& path, const GltfDocument& document, const Scene& scene,
                     const Atlas& atlas, const Image& map, const SceneLighting& lights)
{
    const auto prepare = [&](GlbBuilder& builder, const auto&) {
        for (const std::size_t old : outdated_lightmaps(builder.json, builder.document().json))
            builder.retire_texture(old);
        builder.release();
        tell_of_lights(builder.json, lights);  // data that they refer to is unused from here on
        if (lights.camera)
            add_camera(builder.json, *lights.camera, scene.origin);
    };
    const auto finish = [&](GlbBuilder& builder, const auto& materials) {
        const float scale = lightmap_scale(map, lights.exposure);
        for (std::size_t page = 0; page < materials.size(); ++page) {
            if (lights.format != LightmapFormat::none)
                bind_lightmap(builder.json, materials[page],
                              add_lightmap(builder, cut_page(atlas.pages, int(page), map), scale,
                                           page_name(atlas.pages, int(page), kLightmapName),
                                           lights.format),
                              scale);
            tell_of_lightmap(builder.json, materials[page], atlas.pages, int(page));
        }
        if (!lights.lamps.empty() && lights.format != LightmapFormat::none)
            add_lamps(builder, atlas.pages, lights.lamps);
    };
    rewrite(path, document, scene, atlas, Attributes::all, lights.compression, prepare, finish);
}

void write_baked_glb(const std::string& path, const GltfDocument& document, const Scene& scene,
                     const Atlas& atlas, const Image& shown,
                     const std::optional<AddedCamera>& camera)
{
    const auto prepare = [&](GlbBuilder& builder, const auto& materials) {
        reduce_to_core(builder.json, materials);
        builder.release(Pictures::plain);
        if (camera)
            add_camera(builder.json, *camera, scene.origin);
    };
    const auto finish = [&](GlbBuilder& builder, const auto& materials) {
        erase_extensions(builder.json);
        for (std::size_t page = 0; page < materials.size(); ++page) {
            const Image part = without_alpha(cut_page(atlas.pages, int(page), shown), 1.0f);
            bind_emission(builder.json, materials[page],
                          builder.add_texture(page_name(atlas.pages, int(page), "baked light"),
                                              encode_png(part)));
        }
    };
    rewrite(path, document, scene, atlas, Attributes::visible, Compression::none, prepare, finish);
}

}  // namespace lumel
