#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <optional>

#include <gtest/gtest.h>

#include "../../support/ktx2.h"
#include "../../support/source_folder.h"
#include "../../support/temporary_folder.h"
#include "base/core/error.h"
#include "base/images/image_files.h"
#include "conformance.h"
#include "hand_atlas.h"
#include "results/files/gltf_write.h"
#include "results/files/gzip.h"
#include "results/files/half_map.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/document.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;
using test::conformance_files;
using test::kConformance;
using test::try_read;

// Colour, emission and opacity at a corner, read as a renderer would.
MaterialSample look(const Scene& scene, const Primitive& primitive, std::uint32_t vertex)
{
    glm::vec2 texcoords[kTexcoordSets];
    for (int set = 0; set < kTexcoordSets; ++set)
        if (!primitive.texcoords[set].empty())
            texcoords[set] = primitive.texcoords[set][vertex];
    const glm::vec4 color = primitive.colors.empty() ? glm::vec4(1.0f) : primitive.colors[vertex];
    return sample_material(scene, primitive.material, texcoords, color);
}

bool reads_texcoord_1(const Scene& scene, const Primitive& primitive)
{
    const Material& material = scene.materials.at(std::size_t(primitive.material));
    return material.base_color_texture.texcoord == 1 || material.emissive_texture.texcoord == 1;
}

/// What a written file has of colours and texture coordinates.
enum class Kept {
    all,
    alpha,  ///< what alpha depends on
};

// The corners that `surface` names in `before` are, in order, those of the triangle list in
// `after`.
void expect_same_triangles(const Scene& before, const Scene& after, const Atlas& atlas,
                           const Surface& surface, Kept kept)
{
    const Primitive& old_list = test::primitive_of(before, surface);
    const Primitive& new_list = test::primitive_of(after, surface);
    ASSERT_EQ(new_list.indices.size(), surface.indices.size());
    ASSERT_EQ(new_list.texcoords[1].size(), new_list.positions.size());
    const Material& material = before.materials[std::size_t(old_list.material)];
    const bool has_colors = kept == Kept::all || material.alpha_mode != AlphaMode::opaque;
    const TextureUse& texture = material.base_color_texture;
    const bool has_texcoords =
        kept == Kept::all || (has_colors && texture.texture >= 0 && texture.texcoord == 0);
    EXPECT_TRUE(has_colors || new_list.colors.empty());
    for (std::size_t i = 0; i < surface.indices.size(); ++i) {
        const std::uint32_t old_vertex = surface.source_vertex[surface.indices[i]];
        const std::uint32_t new_vertex = new_list.indices[i];
        ASSERT_EQ(new_list.positions[new_vertex], old_list.positions[old_vertex]);
        ASSERT_EQ(new_list.texcoords[1][new_vertex],
                  surface.texcoord[surface.indices[i]] / glm::vec2(atlas.width, atlas.height));
        if (has_texcoords && !old_list.texcoords[0].empty() &&
            !reads_texcoord_1(before, old_list)) {
            ASSERT_EQ(new_list.texcoords[0][new_vertex], old_list.texcoords[0][old_vertex]);
        }
        if (has_colors && !old_list.colors.empty()) {
            ASSERT_EQ(new_list.colors[new_vertex], old_list.colors[old_vertex]);
        }
        if (!old_list.normals.empty()) {
            ASSERT_LT(glm::distance(new_list.normals[new_vertex], old_list.normals[old_vertex]),
                      1e-5f);
        }
    }
}

void expect_same_instances(const Scene& before, const Scene& after)
{
    ASSERT_EQ(after.instances.size(), before.instances.size());
    for (std::size_t i = 0; i < before.instances.size(); ++i) {
        EXPECT_EQ(after.instances[i].node, before.instances[i].node);
        EXPECT_EQ(after.instances[i].transform, before.instances[i].transform);
    }
    EXPECT_EQ(after.cameras.size(), before.cameras.size());
}

/// The sources of light of a scene with a lamp, a triangle, and extras that are not ours.
std::string lamp_scene()
{
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 7}]}},
        "nodes": [{"mesh": 0},
                  {"translation": [0, 2, 0], "extras": {"note": "mine"},
                   "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
           "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/"
           R"("}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 0, 1]}]})";
}

TEST(GltfWrite, LampsThatAreBakedShineNoMoreButComeBackForALaterBake)
{
    const test::TemporaryFolder folder;
    std::ofstream(folder / "lamp.gltf") << lamp_scene();
    const Scene scene = read_gltf(folder / "lamp.gltf");
    ASSERT_EQ(scene.lights.size(), 1u);
    const Atlas atlas = test::corner_atlas(scene);
    for (const bool keep : {false, true}) {
        write_scene_glb(folder / "scene.glb", load_gltf_document(scene.path), scene, atlas,
                        test::any_map(atlas), {.keep = keep, .exposure = 0.25f});
        std::ifstream file(folder / "scene.glb", std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(file), {});
        EXPECT_EQ(bytes.find(R"("extensions":{"KHR_lights_punctual")") != std::string::npos, keep);
        const Json json = load_gltf_document(folder / "scene.glb").json;
        EXPECT_EQ(json["asset"]["extras"]["lumel"]["bakedLights"], keep ? 0 : 1);
        EXPECT_EQ(json["asset"]["extras"]["lumel"]["exposure"], 0.25);
        EXPECT_EQ(json["nodes"][1]["extras"]["note"], "mine");
        const Scene again = read_gltf(folder / "scene.glb");
        ASSERT_EQ(again.lights.size(), 1u);
        EXPECT_EQ(again.lights[0].intensity, 7.0f);
        EXPECT_EQ(again.lights[0].transform, scene.lights[0].transform);
    }
}

TEST(GltfWrite, ProfilesOfLampsThatAreBakedKeepTheirData)
{
    const test::TemporaryFolder folder;
    Json gltf = Json::parse(lamp_scene());
    gltf["buffers"].push_back(
        {{"byteLength", 58},
         {"uri",
          "data:application/octet-stream;base64,"
          "SUVTTkE5MQpUSUxUPU5PTkUKMSAtMSAxIDIgMSAxIDIgMCAwIDAgMSAxIDEKMCA5MCAwIDMwIDMwCg=="}});
    gltf["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 58}});
    gltf["extensions"]["EXT_lights_ies"]["lights"] =
        Json::array({{{"bufferView", 1}, {"mimeType", "application/x-ies-lm-63"}}});
    gltf["nodes"][1]["extensions"]["EXT_lights_ies"]["light"] = 0;
    std::ofstream(folder / "lamp.gltf") << gltf.dump();
    const Scene scene = read_gltf(folder / "lamp.gltf");
    ASSERT_EQ(scene.profiles.size(), 1u);
    const Atlas atlas = test::corner_atlas(scene);
    write_scene_glb(folder / "scene.glb", load_gltf_document(scene.path), scene, atlas,
                    test::any_map(atlas));
    const Scene again = read_gltf(folder / "scene.glb");
    ASSERT_EQ(again.profiles.size(), 1u);
    EXPECT_EQ(again.profiles[0].candela, scene.profiles[0].candela);
}

TEST(GltfWrite, MapsOfLampsAreInSceneGlbUntilTheNextBake)
{
    const test::TemporaryFolder folder;
    std::ofstream(folder / "lamp.gltf") << lamp_scene();
    const Scene scene = read_gltf(folder / "lamp.gltf");
    const Atlas atlas = test::corner_atlas(scene);
    const Image map = test::any_map(atlas);
    const SceneLamp lamp{.name = "bulb",
                         .kind = "point",
                         .members = {"bulb"},
                         .color = {1.0, 0.5, 0.25},
                         .error = 0.125,
                         .map = &map};
    const std::vector<SceneLamp> lamps(2, lamp);
    const auto write = [&](const char* name, const std::string& from, LightmapFormat format,
                           std::span<const SceneLamp> with) {
        write_scene_glb(folder / name, load_gltf_document(from), read_gltf(from), atlas, map,
                        {.format = format, .lamps = with});
        return load_gltf_document(folder / name);
    };
    const GltfDocument lit = write("scene.glb", scene.path, LightmapFormat::png, lamps);
    const Json& told = lit.json["asset"]["extras"]["lumel"]["lamps"];
    const HalfMap half = half_map(map);
    EXPECT_EQ(told["list"][1], (Json{{"name", "bulb"},
                                     {"kind", "point"},
                                     {"members", {"bulb"}},
                                     {"color", {1.0, 0.5, 0.25}},
                                     {"error", 0.125},
                                     {"brightest", {shortest(half.brightest)}}}));
    EXPECT_EQ(told["width"], half.width);
    EXPECT_EQ(told["height"], half.height);
    std::vector<std::uint8_t> both = half.bytes;
    both.insert(both.end(), half.bytes.begin(), half.bytes.end());
    const std::vector<std::uint8_t> packed = gzip(both);
    const Bytes bytes = read_linked_bytes(lit, JsonView("", told));
    EXPECT_TRUE(std::ranges::equal(bytes, packed));

    // A later bake of the file drops them, and their bytes.
    const GltfDocument again = write("again.glb", lit.path, LightmapFormat::png, {});
    const GltfDocument plain = write("plain.glb", scene.path, LightmapFormat::png, {});
    const GltfDocument twice = write("twice.glb", plain.path, LightmapFormat::png, {});
    EXPECT_FALSE(lamps_view_in_extras(again.json));
    EXPECT_EQ(again.buffers, twice.buffers);
    EXPECT_FALSE(
        lamps_view_in_extras(write("none.glb", scene.path, LightmapFormat::none, lamps).json));
    write_baked_glb(folder / "baked.glb", lit, read_gltf(lit.path), atlas, map);
    EXPECT_FALSE(lamps_view_in_extras(load_gltf_document(folder / "baked.glb").json));
}

TEST(GltfWrite, EveryTriangleOfEveryLoadableFileComesBackInItsPlace)
{
    if (conformance_files().empty())
        GTEST_SKIP() << "no conformance files at " << kConformance;
    const test::TemporaryFolder folder;
    std::size_t tried = 0;
    for (const std::string& path : conformance_files()) {
        SCOPED_TRACE(path);
        const std::optional<Scene> scene = try_read(path);
        if (!scene)
            continue;
        ++tried;
        const Atlas atlas = test::corner_atlas(*scene);
        write_scene_glb(folder / "scene.glb", load_gltf_document(scene->path), *scene, atlas,
                        test::any_map(atlas));
        write_baked_glb(folder / "baked.glb", load_gltf_document(scene->path), *scene, atlas,
                        test::any_map(atlas));
        for (const auto& [name, kept] :
             {std::pair("scene.glb", Kept::all), std::pair("baked.glb", Kept::alpha)}) {
            SCOPED_TRACE(name);
            const Scene after = read_gltf(folder / name);
            expect_same_instances(*scene, after);
            for (const Surface& surface : atlas.surfaces)
                expect_same_triangles(*scene, after, atlas, surface, kept);
            if (HasFatalFailure())
                return;
        }
    }
    EXPECT_GT(tried, 100u);
}

TEST(GltfWrite, CompressedGeometryIsThatOfThePlainFileByteForByte)
{
    if (conformance_files().empty())
        GTEST_SKIP() << "no conformance files at " << kConformance;
    const test::TemporaryFolder folder;
    std::size_t compressed = 0;
    for (const std::string& path : conformance_files()) {
        SCOPED_TRACE(path);
        const std::optional<Scene> scene = try_read(path);
        if (!scene)
            continue;
        const Atlas atlas = test::shared_atlas(*scene);
        const GltfDocument document = load_gltf_document(scene->path);
        const auto write = [&](const char* name, Compression compression) {
            write_scene_glb(folder / name, document, *scene, atlas, test::any_map(atlas),
                            {.format = LightmapFormat::none, .compression = compression});
            return load_gltf_document(folder / name);
        };
        const GltfDocument plain = write("plain.glb", Compression::none);
        const GltfDocument packed = write("packed.glb", Compression::meshopt);
        std::ifstream file(folder / "packed.glb", std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(file), {});
        if (bytes.find("EXT_meshopt_compression") != std::string::npos)
            ++compressed;
        ASSERT_EQ(packed.json["accessors"], plain.json["accessors"]);
        ASSERT_EQ(packed.json["meshes"], plain.json["meshes"]);
        for (std::size_t i = 0; i < plain.json["accessors"].size(); ++i)
            if (plain.json["accessors"][i].contains("bufferView")) {
                ASSERT_EQ(read_accessor(packed, i).bytes, read_accessor(plain, i).bytes);
            }
        EXPECT_EQ(read_gltf(folder / "packed.glb").hash, read_gltf(folder / "plain.glb").hash);
    }
    EXPECT_GT(compressed, 50u);
}

TEST(GltfWrite, MaterialsLookAsBeforeInSceneGlb)
{
    if (conformance_files().empty())
        GTEST_SKIP() << "no conformance files at " << kConformance;
    const test::TemporaryFolder folder;
    for (const std::string& path : conformance_files()) {
        SCOPED_TRACE(path);
        const std::optional<Scene> scene = try_read(path);
        if (!scene)
            continue;
        const Atlas atlas = test::corner_atlas(*scene);
        write_scene_glb(folder / "scene.glb", load_gltf_document(scene->path), *scene, atlas,
                        test::any_map(atlas));
        const Scene after = read_gltf(folder / "scene.glb");
        for (const Surface& surface : atlas.surfaces) {
            const Primitive& old_list = test::primitive_of(*scene, surface);
            const Primitive& new_list = test::primitive_of(after, surface);
            for (std::size_t i = 0; i < surface.indices.size(); i += 7) {
                const std::uint32_t vertex = surface.source_vertex[surface.indices[i]];
                const MaterialSample a = look(*scene, old_list, vertex);
                const MaterialSample b = look(after, new_list, new_list.indices[i]);
                ASSERT_EQ(a.albedo, b.albedo);
                ASSERT_EQ(a.emitted, b.emitted);
                ASSERT_EQ(a.opacity, b.opacity);
            }
        }
    }
}

}  // namespace
}  // namespace lumel
