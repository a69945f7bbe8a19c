#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "../support/ktx2.h"
#include "../support/source_folder.h"
#include "../support/temporary_folder.h"
#include "core/error.h"
#include "gltf/accessor.h"
#include "gltf/document.h"
#include "hand_atlas.h"
#include "images/image_files.h"
#include "output/gltf_write.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

const fs::path kConformance = support::data_path("gltf_conformance");

std::vector<std::string> conformance_files()
{
    std::vector<std::string> files;
    if (fs::exists(kConformance))
        for (const auto& entry : fs::recursive_directory_iterator(kConformance))
            if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
                files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

std::optional<Scene> try_read(const std::string& path)
{
    try {
        return read_gltf(path);
    } catch (const Error&) {
        return std::nullopt;
    }
}

const Primitive& primitive_of(const Scene& scene, const Surface& surface)
{
    const Instance& instance = scene.instances.at(surface.instance);
    return scene.meshes.at(std::size_t(instance.mesh)).primitives.at(surface.primitive);
}

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

// The corners that `surface` names in `before` are, in order, those of the triangle list in
// `after`.
void expect_same_triangles(const Scene& before, const Scene& after, const Atlas& atlas,
                           const Surface& surface)
{
    const Primitive& old_list = primitive_of(before, surface);
    const Primitive& new_list = primitive_of(after, surface);
    ASSERT_EQ(new_list.indices.size(), surface.indices.size());
    ASSERT_EQ(new_list.texcoords[1].size(), new_list.positions.size());
    for (std::size_t i = 0; i < surface.indices.size(); ++i) {
        const std::uint32_t old_vertex = surface.source_vertex[surface.indices[i]];
        const std::uint32_t new_vertex = new_list.indices[i];
        ASSERT_EQ(new_list.positions[new_vertex], old_list.positions[old_vertex]);
        ASSERT_EQ(new_list.texcoords[1][new_vertex],
                  surface.texcoord[surface.indices[i]] / glm::vec2(atlas.width, atlas.height));
        if (!old_list.texcoords[0].empty() && !reads_texcoord_1(before, old_list)) {
            ASSERT_EQ(new_list.texcoords[0][new_vertex], old_list.texcoords[0][old_vertex]);
        }
        if (!old_list.colors.empty()) {
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
        write_scene_glb(folder / "scene.glb", scene, atlas, test::any_map(atlas),
                        {.keep = keep, .exposure = 0.25f});
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
    write_scene_glb(folder / "scene.glb", scene, atlas, test::any_map(atlas));
    const Scene again = read_gltf(folder / "scene.glb");
    ASSERT_EQ(again.profiles.size(), 1u);
    EXPECT_EQ(again.profiles[0].candela, scene.profiles[0].candela);
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
        write_scene_glb(folder / "scene.glb", *scene, atlas, test::any_map(atlas));
        write_baked_glb(folder / "baked.glb", *scene, atlas, test::any_map(atlas));
        for (const char* name : {"scene.glb", "baked.glb"}) {
            SCOPED_TRACE(name);
            const Scene after = read_gltf(folder / name);
            expect_same_instances(*scene, after);
            for (const Surface& surface : atlas.surfaces)
                expect_same_triangles(*scene, after, atlas, surface);
            if (HasFatalFailure())
                return;
        }
    }
    EXPECT_GT(tried, 100u);
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
        write_scene_glb(folder / "scene.glb", *scene, atlas, test::any_map(atlas));
        const Scene after = read_gltf(folder / "scene.glb");
        for (const Surface& surface : atlas.surfaces) {
            const Primitive& old_list = primitive_of(*scene, surface);
            const Primitive& new_list = primitive_of(after, surface);
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

// A file of its own: two nodes show one mesh of one quad, whose colour is read through TEXCOORD_1.
class TwoQuads : public testing::Test {
protected:
    void SetUp() override
    {
        std::ofstream(folder_ / "quad.bin", std::ios::binary)
            .write(reinterpret_cast<const char*>(kData), sizeof kData);
        Image texture(1, 1, 3);
        texture.values = {1.0f, 0.0f, 0.0f};
        write_png(folder_ / "red.png", texture);
    }

    Json file() const
    {
        return Json::parse(R"({
            "asset": {"version": "2.0", "generator": "a test", "copyright": "nobody"},
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
            "scene": 0, "scenes": [{"nodes": [0, 1, 3]}],
            "nodes": [{"mesh": 0, "name": "left"},
                      {"mesh": 0, "translation": [2, 0, 0]},
                      {"mesh": 0, "name": "outside"},
                      {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
            "meshes": [{"name": "quad", "extras": {"kept": true}, "primitives": [{
                "attributes": {"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 1}, "mode": 5,
                "material": 0, "extras": {"also": "kept"}}]}],
            "materials": [{"name": "red", "pbrMetallicRoughness": {"baseColorTexture":
                {"index": 0, "texCoord": 1}}}],
            "textures": [{"source": 0}], "images": [{"uri": "red.png"}],
            "buffers": [{"uri": "quad.bin", "byteLength": 80}],
            "bufferViews": [{"buffer": 0, "byteLength": 48},
                            {"buffer": 0, "byteOffset": 48, "byteLength": 32}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}]
        })");
    }

    Scene scene(const Json& json) const
    {
        std::ofstream(folder_ / "quads.gltf") << json.dump();
        return read_gltf(folder_ / "quads.gltf");
    }

    Json lit(const Json& json) const
    {
        const Scene read = scene(json);
        const Atlas atlas = test::corner_atlas(read);
        write_scene_glb(folder_ / "scene.glb", read, atlas, test::any_map(atlas));
        return load_gltf_document(folder_ / "scene.glb").json;
    }

    Json baked(const Json& json) const
    {
        const Scene read = scene(json);
        const Atlas atlas = test::corner_atlas(read);
        write_baked_glb(folder_ / "baked.glb", read, atlas, test::any_map(atlas));
        return load_gltf_document(folder_ / "baked.glb").json;
    }

    static constexpr float kData[20] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 1, 1};
    test::TemporaryFolder folder_;
};

TEST_F(TwoQuads, EachInstanceGetsItsOwnMeshAndOthersKeepTheirs)
{
    const Json json = lit(file());
    EXPECT_EQ(json["nodes"][2]["mesh"], 0);
    EXPECT_NE(json["nodes"][0]["mesh"], 0);
    EXPECT_NE(json["nodes"][1]["mesh"], 0);
    EXPECT_NE(json["nodes"][0]["mesh"], json["nodes"][1]["mesh"]);
    EXPECT_EQ(json["meshes"][0], file()["meshes"][0]);
}

TEST_F(TwoQuads, NamesExtrasAndLightsAreKept)
{
    const Json json = lit(file());
    const Json& mesh = json["meshes"][json["nodes"][1]["mesh"].get<std::size_t>()];
    EXPECT_EQ(mesh["name"], "quad");
    EXPECT_EQ(mesh["extras"]["kept"], true);
    EXPECT_EQ(mesh["primitives"][0]["extras"]["also"], "kept");
    EXPECT_EQ(json["asset"]["copyright"], "nobody");
    EXPECT_EQ(json["extensions"], file()["extensions"]);
    EXPECT_EQ(json["nodes"][3], file()["nodes"][3]);
}

TEST_F(TwoQuads, TheLightmapIsBoundByAnOptionalExtension)
{
    const Json json = lit(file());
    // Its lamps are baked.
    EXPECT_EQ(json["extensionsUsed"], Json({"KHR_texture_basisu", "MOZ_lightmap"}));
    EXPECT_FALSE(json.contains("extensionsRequired"));
    const Json& primitive =
        json["meshes"][json["nodes"][0]["mesh"].get<std::size_t>()]["primitives"][0];
    const Json& material = json["materials"][primitive["material"].get<std::size_t>()];
    const Json& lightmap = material["extensions"]["MOZ_lightmap"];
    EXPECT_EQ(lightmap["texCoord"], 1);
    EXPECT_EQ(lightmap["intensity"].get<float>(), 131.0f);
    const Json& texture = json["textures"][lightmap["index"].get<std::size_t>()];
    EXPECT_EQ(json["images"][texture["source"].get<std::size_t>()]["mimeType"], "image/png");
}

// What tools that drop the extension leave.
TEST_F(TwoQuads, ExtrasOfBakedMaterialsNameTheMapBesideTheFile)
{
    Json noted = file();
    noted["materials"][0]["extras"] = {{"note", "mine"}};
    const Json json = lit(noted);
    std::size_t baked = 0;
    for (const Json& material : json["materials"]) {
        EXPECT_EQ(material["extras"]["note"], "mine");
        if (!material.value("extensions", Json::object()).contains("MOZ_lightmap"))
            continue;
        ++baked;
        EXPECT_EQ(material["extras"]["lumel"],
                  Json({{"lightmap", "lightmap.exr"}, {"texCoord", 1}}));
    }
    EXPECT_EQ(baked, 1u);
    EXPECT_FALSE(json["materials"][0]["extras"].contains("lumel"));
}

TEST_F(TwoQuads, TheDensityOfAMaterialStaysWithIt)
{
    Json dense = file();
    dense["materials"][0]["extras"] = {{"lumel", {{"texels_per_metre", 40}}}};
    for (const Json& material : lit(dense)["materials"])
        EXPECT_EQ(material["extras"]["lumel"]["texels_per_metre"], 40);
}

/// Light from 0.01 to 10^6 lx: most of it dim, a thousandth of it very bright.
Image wide_map(const Atlas& atlas)
{
    Image map = test::any_map(atlas);
    const std::size_t texels = map.values.size() / 4;
    for (std::size_t i = 0; i < texels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            map.values[4 * i + c] = i * 2000 < texels ? 1e6f
                                                      : std::exp2(float(i % 1371) * 0.01f - 6.6f) *
                                                            (1.0f + 0.3f * float(c));
    return map;
}

/// The lightmap in a scene.glb as a loader of KHR_texture_basisu reads it [lx].
Image bound_map(const std::string& path)
{
    const GltfDocument document = load_gltf_document(path);
    const Json& json = document.json;
    for (const Json& material : json["materials"]) {
        if (!material.contains("extensions"))
            continue;
        const Json& lightmap = material["extensions"]["MOZ_lightmap"];
        const Json& texture = json["textures"][lightmap["index"].get<std::size_t>()];
        const Json& ktx2 = texture["extensions"]["KHR_texture_basisu"];
        const Json& image = json["images"][ktx2["source"].get<std::size_t>()];
        EXPECT_EQ(image["mimeType"], "image/ktx2");
        const Json& view = json["bufferViews"][image["bufferView"].get<std::size_t>()];
        Image map = test::decode_ktx2(std::span(document.buffers[0])
                                          .subspan(view["byteOffset"].get<std::size_t>(),
                                                   view["byteLength"].get<std::size_t>()));
        for (float& value : map.values)
            value *= lightmap["intensity"].get<float>();
        return map;
    }
    throw std::runtime_error("no material has a lightmap");
}

TEST_F(TwoQuads, TheBoundLightmapIsWithinAPercentOverTheWholeRangeAndClipsNothing)
{
    const Scene read = scene(file());
    const Atlas atlas = test::corner_atlas(read, 128);
    const Image map = wide_map(atlas);
    std::vector<float> values;
    for (std::size_t i = 0; i < map.values.size(); ++i)
        if (i % 4 != 3)
            values.push_back(map.values[i]);
    const std::vector<float> given = values;
    const auto high = values.begin() + std::ptrdiff_t(0.999 * double(values.size()));
    std::nth_element(values.begin(), high, values.end());
    for (const LightmapFormat format : {LightmapFormat::ktx2, LightmapFormat::rgb9e5})
        for (const float exposure : {1e-6f, 0.01f, 100.0f}) {
            write_scene_glb(folder_ / "scene.glb", read, atlas, map,
                            {.exposure = exposure, .format = format});
            const Image bound = bound_map(folder_ / "scene.glb");
            ASSERT_EQ(bound.values.size(), given.size());
            std::size_t checked = 0;
            for (std::size_t i = 0; i < given.size(); ++i)
                if (given[i] >= 1e-4f * *high) {
                    ++checked;
                    ASSERT_NEAR(bound.values[i], given[i], 0.01f * given[i]);
                }
            EXPECT_GT(checked, given.size() / 2);
        }
}

TEST_F(TwoQuads, WithoutAFormatNoMapIsInTheFile)
{
    const Scene read = scene(file());
    const Atlas atlas = test::corner_atlas(read);
    write_scene_glb(folder_ / "scene.glb", read, atlas, test::any_map(atlas),
                    {.format = LightmapFormat::none});
    const Json json = load_gltf_document(folder_ / "scene.glb").json;
    EXPECT_FALSE(json.contains("extensionsUsed"));
    EXPECT_EQ(json["images"].size(), 1u);
    EXPECT_EQ(json["materials"][1]["extras"]["lumel"]["lightmap"], "lightmap.exr");
}

TEST_F(TwoQuads, AColourThatWasReadThroughTexcoord1MovesWithItsTexcoords)
{
    const Json json = lit(file());
    const Json& primitive =
        json["meshes"][json["nodes"][0]["mesh"].get<std::size_t>()]["primitives"][0];
    const Json& material = json["materials"][primitive["material"].get<std::size_t>()];
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"], 0);
    EXPECT_FALSE(primitive["attributes"].contains("TEXCOORD_2"));
    // The mesh outside the scene still reads its own, so its material is as it was.
    EXPECT_EQ(json["materials"][0], file()["materials"][0]);
}

TEST_F(TwoQuads, WhereBothTexcoordsAreReadTheOlderLightmapPlaceGetsTheNextNumber)
{
    Json both = file();
    both["materials"][0]["normalTexture"] = {{"index", 0}};
    const Json json = lit(both);
    const Json& primitive =
        json["meshes"][json["nodes"][0]["mesh"].get<std::size_t>()]["primitives"][0];
    const Json& material = json["materials"][primitive["material"].get<std::size_t>()];
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"], 2);
    EXPECT_FALSE(material["normalTexture"].contains("texCoord"));
    EXPECT_TRUE(primitive["attributes"].contains("TEXCOORD_2"));
}

TEST_F(TwoQuads, WhereBothTexcoordsAreReadWhatIsWrittenReadsTheSameAndIsWrittenAgainTheSame)
{
    Json both = file();
    both["materials"][0]["emissiveFactor"] = {1, 1, 1};
    both["materials"][0]["emissiveTexture"] = {{"index", 0}};
    both["accessors"].push_back(both["accessors"][1]);
    both["accessors"][2]["bufferView"] = 0;
    both["accessors"][2]["type"] = "VEC2";
    both["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
    const Scene before = scene(both);
    const Atlas atlas = test::corner_atlas(before);
    write_scene_glb(folder_ / "scene.glb", before, atlas, test::any_map(atlas));
    const Scene after = read_gltf(folder_ / "scene.glb");
    for (const Surface& surface : atlas.surfaces) {
        const Primitive &old = primitive_of(before, surface), &now = primitive_of(after, surface);
        for (std::size_t i = 0; i < surface.indices.size(); ++i) {
            const std::uint32_t source = surface.source_vertex[surface.indices[i]];
            EXPECT_EQ(now.texcoords[0][now.indices[i]], old.texcoords[0][source]);
            EXPECT_EQ(now.texcoords[2][now.indices[i]], old.texcoords[1][source]);
        }
        const Material& material = after.materials.at(std::size_t(now.material));
        EXPECT_EQ(material.base_color_texture.texcoord, 2);
        EXPECT_EQ(material.emissive_texture.texcoord, 0);
    }

    const Atlas again = test::corner_atlas(after);
    write_scene_glb(folder_ / "again.glb", after, again, test::any_map(again));
    const Json json = load_gltf_document(folder_ / "again.glb").json;
    const Json& mesh = json["meshes"][json["nodes"][0]["mesh"].get<std::size_t>()];
    const Json& attributes = mesh["primitives"][0]["attributes"];
    EXPECT_TRUE(attributes.contains("TEXCOORD_2"));
    EXPECT_FALSE(attributes.contains("TEXCOORD_3"));
}

TEST_F(TwoQuads, EveryVariantShowsTheLightmap)
{
    const char* variants = "KHR_materials_variants";
    Json json = file();
    json["extensionsUsed"].push_back(variants);
    json["extensions"][variants]["variants"] = {{{"name", "at night"}}};
    json["materials"].push_back({{"name", "blue"}});
    json["meshes"][0]["primitives"][0]["extensions"][variants]["mappings"] = {
        {{"material", 1}, {"variants", {0}}}};
    const Json written = lit(json);
    for (const std::size_t node : {0, 1}) {
        const auto mesh = written["nodes"][node]["mesh"].get<std::size_t>();
        const Json& primitive = written["meshes"][mesh]["primitives"][0];
        const Json& mapping = primitive["extensions"][variants]["mappings"][0];
        const Json& material = written["materials"][mapping["material"].get<std::size_t>()];
        EXPECT_EQ(material["name"], "blue");
        EXPECT_TRUE(material.contains(Json::json_pointer("/extensions/MOZ_lightmap")));
    }
    EXPECT_EQ(written["materials"][1], json["materials"][1]);  // of the mesh outside the scene
}

TEST_F(TwoQuads, AMaterialThatOnlyBakedMeshesUseIsNotCopied)
{
    Json alone = file();
    alone["nodes"][2].erase("mesh");
    EXPECT_EQ(lit(alone)["materials"].size(), 1u);
}

TEST_F(TwoQuads, ReplacedArraysLeaveTheFile)
{
    Json alone = file();
    alone["nodes"][2].erase("mesh");
    const auto size = [](const Json& json) {
        return json["buffers"][0]["byteLength"].get<std::size_t>();
    };
    // Four vertices of 20 bytes stay with the mesh outside the scene, and only with it.
    EXPECT_EQ(size(lit(file())), size(lit(alone)) + 80u);
}

TEST_F(TwoQuads, BakedMaterialsReflectNothingAndEmitTheMap)
{
    const Json json = baked(file());
    EXPECT_FALSE(json.contains("extensionsUsed"));
    EXPECT_FALSE(json.contains("extensions"));
    const Json& primitive =
        json["meshes"][json["nodes"][0]["mesh"].get<std::size_t>()]["primitives"][0];
    const Json& material = json["materials"][primitive["material"].get<std::size_t>()];
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"], Json({0.0, 0.0, 0.0, 1.0}));
    EXPECT_FALSE(material["pbrMetallicRoughness"].contains("baseColorTexture"));
    EXPECT_EQ(material["emissiveTexture"]["texCoord"], 1);
}

TEST_F(TwoQuads, CutOutsKeepTheirAlphaWhenBaked)
{
    Json cut_out = file();
    cut_out["materials"][0]["alphaMode"] = "MASK";
    cut_out["materials"][0]["alphaCutoff"] = 0.25;
    cut_out["nodes"][2].erase("mesh");
    const Json json = baked(cut_out);
    const Json& material = json["materials"][0];
    EXPECT_EQ(material["alphaMode"], "MASK");
    EXPECT_EQ(material["alphaCutoff"], 0.25);
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"], 0);
}

TEST_F(TwoQuads, TheSameInputGivesTheSameBytes)
{
    lit(file());
    const std::vector<char> first = test::bytes_of(folder_ / "scene.glb");
    lit(file());
    EXPECT_EQ(test::bytes_of(folder_ / "scene.glb"), first);
}

TEST_F(TwoQuads, BakingAgainReplacesTheOlderLightmap)
{
    lit(file());
    const std::vector<char> first = test::bytes_of(folder_ / "scene.glb");
    const Scene again = read_gltf(folder_ / "scene.glb");
    const Atlas atlas = test::corner_atlas(again);
    write_scene_glb(folder_ / "again.glb", again, atlas, test::any_map(atlas));
    const Json json = load_gltf_document(folder_ / "again.glb").json;
    EXPECT_EQ(json["images"].size(), 3u);
    EXPECT_EQ(json["textures"].size(), 2u);
    EXPECT_EQ(json["samplers"].size(), 1u);
    EXPECT_EQ(test::bytes_of(folder_ / "again.glb").size(), first.size());
}

TEST_F(TwoQuads, AnOlderLightmapWithAnImageThatIsNotThereIsReplacedToo)
{
    constexpr std::size_t kNotThere = 99;
    Json json = file();
    json["extensionsUsed"] = {"MOZ_lightmap", "KHR_texture_basisu"};
    json["images"].push_back({{"uri", "red.png"}});
    json["textures"].push_back(
        {{"source", 1}, {"extensions", {{"KHR_texture_basisu", {{"source", kNotThere}}}}}});
    json["materials"][0]["extensions"]["MOZ_lightmap"] = {{"index", 1}};
    json["nodes"][2].erase("mesh");  // nobody else shows the older map
    const Json written = lit(json);
    EXPECT_EQ(written["images"].size(), 3u);  // red, and the map in two forms
    for (const Json& image : written["images"])
        EXPECT_TRUE(image.is_object()) << image;
}

TEST_F(TwoQuads, AnOlderLightmapThatSomethingElseShowsStays)
{
    Json json = file();
    json["extensionsUsed"] = {"MOZ_lightmap"};
    json["images"].push_back({{"uri", "red.png"}, {"name", "older map"}});
    json["textures"].push_back({{"source", 1}});
    json["materials"][0]["extensions"]["MOZ_lightmap"] = {{"index", 1}};
    const Json mesh_shows_it = lit(json);  // that outside the scene
    EXPECT_EQ(mesh_shows_it["textures"][1], json["textures"][1]);
    EXPECT_EQ(mesh_shows_it["images"][1]["name"], "older map");

    json["nodes"][2].erase("mesh");
    json["textures"].push_back({{"source", 1}, {"name", "colour"}});
    json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 2;
    const Json texture_shows_it = lit(json);
    EXPECT_EQ(texture_shows_it["images"][1]["name"], "older map");
}

TEST_F(TwoQuads, AFileThatChangedMeanwhileIsAnError)
{
    const Scene before = scene(file());
    const Atlas atlas = test::corner_atlas(before);
    Json other = file();
    other["nodes"][0].erase("mesh");
    scene(other);
    EXPECT_THROW(write_scene_glb(folder_ / "scene.glb", before, atlas, test::any_map(atlas)),
                 Error);
}

// Each of the scene's surfaces has its back at another place of the map.
Atlas with_own_backs(Atlas atlas)
{
    atlas.back_shift.assign(atlas.chart_count, glm::ivec2(1, 2));
    return atlas;
}

/// The file as viewers read it, who know nothing of our marks.
std::string without_marks(const std::string& path, const std::string& copy)
{
    const std::vector<char> bytes = test::bytes_of(path);
    std::string text(bytes.begin(), bytes.end());
    const std::string mark = "\"lumel_side\"", unknown = "\"other_side\"";
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;)
        text.replace(at, mark.size(), unknown);
    std::ofstream(copy, std::ios::binary) << text;
    return copy;
}

/// Each element of an attribute.
std::vector<glm::vec4> attribute(const GltfDocument& document, const Json& primitive,
                                 const char* name)
{
    const std::vector<float> values =
        to_floats(read_accessor(document, primitive["attributes"][name].get<std::size_t>()));
    const std::size_t each = std::string(name) == "TANGENT" ? 4 : 3;
    std::vector<glm::vec4> elements(values.size() / each, glm::vec4(0.0f));
    for (std::size_t i = 0; i < values.size(); ++i)
        elements[i / each][int(i % each)] = values[i];
    return elements;
}

/// What a texel of a normal map makes of the normal.
glm::vec3 bent(const glm::vec3& normal, const glm::vec4& tangent, const glm::vec3& texel)
{
    return texel.x * glm::vec3(tangent) +
           texel.y * tangent.w * glm::cross(normal, glm::vec3(tangent)) + texel.z * normal;
}

// glTF turns the bent normal of double-sided materials where the back is seen.
TEST_F(TwoQuads, BacksBendTheirNormalsAsBacksOfDoubleSidedSurfacesDo)
{
    constexpr glm::vec3 kNormal(0.0f, 0.0f, 1.0f), kTexel(0.3f, 0.5f, 0.8f);
    constexpr glm::vec4 kTangent(0.6f, 0.8f, 0.0f, 1.0f);
    std::ofstream bytes(folder_ / "tangents.bin", std::ios::binary);
    for (int i = 0; i < 4; ++i)
        bytes.write(reinterpret_cast<const char*>(&kNormal), sizeof kNormal);
    for (int i = 0; i < 4; ++i)
        bytes.write(reinterpret_cast<const char*>(&kTangent), sizeof kTangent);
    bytes.close();
    Json json = file();
    json["buffers"].push_back({{"uri", "tangents.bin"}, {"byteLength", 112}});
    json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 48}});
    json["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 48}, {"byteLength", 64}});
    json["accessors"].push_back(
        {{"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    json["accessors"].push_back(
        {{"bufferView", 3}, {"componentType", 5126}, {"count", 4}, {"type", "VEC4"}});
    json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
    json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = 3;
    json["materials"][0]["doubleSided"] = true;

    const Scene read = scene(json);
    const Atlas atlas = with_own_backs(test::corner_atlas(read));
    write_scene_glb(folder_ / "out.glb", read, atlas, test::any_map(atlas));
    const GltfDocument written =
        load_gltf_document(without_marks(folder_ / "out.glb", folder_ / "viewed.glb"));
    const auto mesh = written.json["nodes"][0]["mesh"].get<std::size_t>();
    const Json& primitives = written.json["meshes"][mesh]["primitives"];
    ASSERT_EQ(primitives.size(), 2u);
    const auto normals = attribute(written, primitives[1], "NORMAL"),
               tangents = attribute(written, primitives[1], "TANGENT");
    ASSERT_FALSE(normals.empty());
    ASSERT_EQ(normals.size(), tangents.size());
    for (std::size_t i = 0; i < normals.size(); ++i)
        EXPECT_LT(glm::distance(bent(glm::vec3(normals[i]), tangents[i], kTexel),
                                -bent(kNormal, kTangent, kTexel)),
                  1e-6f);
}

// The least whole number has no opposite, and stands for the same direction as the one after it.
template <class T>
void write_least_normals(const std::string& path)
{
    constexpr T kNormalAndFiller[4] = {0, 0, std::numeric_limits<T>::min(), 0};
    std::ofstream file(path, std::ios::binary);
    for (int vertex = 0; vertex < 4; ++vertex)
        file.write(reinterpret_cast<const char*>(kNormalAndFiller), sizeof kNormalAndFiller);
}

TEST_F(TwoQuads, NormalsOfBacksPointTheOtherWayInWholeNumbersToo)
{
    constexpr int kByte = 5120, kShort = 5122;
    write_least_normals<std::int8_t>(folder_ / "normals-5120.bin");
    write_least_normals<std::int16_t>(folder_ / "normals-5122.bin");
    for (const int type : {kByte, kShort}) {
        const int stride = type == kByte ? 4 : 8;
        Json json = file();
        json["extensionsUsed"].push_back("KHR_mesh_quantization");
        json["extensionsRequired"] = {"KHR_mesh_quantization"};
        json["buffers"].push_back(
            {{"uri", "normals-" + std::to_string(type) + ".bin"}, {"byteLength", 4 * stride}});
        json["bufferViews"].push_back(
            {{"buffer", 1}, {"byteLength", 4 * stride}, {"byteStride", stride}});
        json["accessors"].push_back({{"bufferView", 2},
                                     {"componentType", type},
                                     {"normalized", true},
                                     {"count", 4},
                                     {"type", "VEC3"}});
        json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
        json["materials"][0]["doubleSided"] = true;

        const Scene read = scene(json);
        const Atlas atlas = with_own_backs(test::corner_atlas(read));
        write_scene_glb(folder_ / "out.glb", read, atlas, test::any_map(atlas));
        const Scene viewed = read_gltf(without_marks(folder_ / "out.glb", folder_ / "viewed.glb"));
        const Mesh& mesh = viewed.meshes[std::size_t(viewed.instances[0].mesh)];
        ASSERT_EQ(mesh.primitives.size(), 2u);
        for (const glm::vec3& normal : mesh.primitives[0].normals)
            EXPECT_EQ(normal, glm::vec3(0.0f, 0.0f, -1.0f)) << type;
        for (const glm::vec3& normal : mesh.primitives[1].normals)
            EXPECT_EQ(normal, glm::vec3(0.0f, 0.0f, 1.0f)) << type;
    }
}

TEST(GltfWrite, HasAFaceForEachSideAndIsReadAsDoubleSidedAgain)
{
    const test::TemporaryFolder folder;
    Json file = Json::parse(std::ifstream(support::source_path("scenes/cornell-box.gltf")));
    for (Json& material : file["materials"])
        material["doubleSided"] = true;
    std::ofstream(folder / "in.gltf") << file;
    const Scene scene = read_gltf(folder / "in.gltf");
    const Atlas atlas = with_own_backs(test::corner_atlas(scene));
    write_scene_glb(folder / "out.glb", scene, atlas, test::any_map(atlas), {});

    // As any viewer has it: two single-sided faces, turned away from each other, the second at the
    // place of the back.
    const Scene viewed = read_gltf(without_marks(folder / "out.glb", folder / "viewed.glb"));
    for (const Material& material : viewed.materials)
        EXPECT_FALSE(material.double_sided);
    ASSERT_EQ(viewed.instances.size(), scene.instances.size());
    for (const Instance& instance : viewed.instances) {
        const Mesh& mesh = viewed.meshes[std::size_t(instance.mesh)];
        ASSERT_EQ(mesh.primitives.size(), 2u);
        const Primitive &front = mesh.primitives[0], &back = mesh.primitives[1];
        ASSERT_EQ(front.indices.size(), back.indices.size());
        for (std::size_t k = 0; k < front.indices.size(); ++k) {
            const std::uint32_t a = front.indices[k], b = back.indices[k % 3 == 0   ? k
                                                                       : k % 3 == 1 ? k + 1
                                                                                    : k - 1];
            EXPECT_EQ(front.positions[a], back.positions[b]);
            EXPECT_EQ(front.normals[a], -back.normals[b]);
            const glm::vec2 apart = (back.texcoords[1][b] - front.texcoords[1][a]) *
                                    glm::vec2(atlas.width, atlas.height);
            EXPECT_NEAR(apart.x, 1.0f, 1e-3f);
            EXPECT_NEAR(apart.y, 2.0f, 1e-3f);
        }
    }

    const Scene read = read_gltf(folder / "out.glb");
    for (const Instance& instance : read.instances) {
        const Mesh& mesh = read.meshes[std::size_t(instance.mesh)];
        ASSERT_EQ(mesh.primitives.size(), 1u);
        EXPECT_TRUE(read.materials[std::size_t(mesh.primitives[0].material)].double_sided);
    }
}

}  // namespace
}  // namespace lumel
