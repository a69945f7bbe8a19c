// What writers keep of a file, and what they add.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "../../support/ktx2.h"
#include "base/core/error.h"
#include "two_quads.h"

namespace lumel {
namespace {

using test::TwoQuads;

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

TEST_F(TwoQuads, AnAddedCameraSeesFromWhereItIs)
{
    constexpr float kExtent = 4.0f;
    for (const double far : {0.0, 1e6}) {
        Json json = file();
        for (const int root : {0, 1})
            json["nodes"][std::size_t(root)]["translation"] = {far + 2.0 * root, 0.0, 0.0};
        const Scene read = scene(json);
        const Atlas atlas = test::corner_atlas(read);
        View view{.vertical_fov = 1.1f, .aspect = 1.5f};
        view.transform = glm::mat4({0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {1, 2, 3, 1});
        write_scene_glb(folder_ / "scene.glb", load_gltf_document(read.path), read, atlas,
                        test::any_map(atlas), {.camera = AddedCamera{view, kExtent}});
        write_baked_glb(folder_ / "baked.glb", load_gltf_document(read.path), read, atlas,
                        test::any_map(atlas), AddedCamera{view, kExtent});
        EXPECT_EQ(load_gltf_document(folder_ / "baked.glb").json["cameras"],
                  load_gltf_document(folder_ / "scene.glb").json["cameras"]);
        const Scene again = read_gltf(folder_ / "scene.glb");
        ASSERT_EQ(again.cameras.size(), 1u);
        const View seen = view_of(again.cameras[0]);
        EXPECT_EQ(seen.vertical_fov, view.vertical_fov);
        EXPECT_EQ(seen.aspect, view.aspect);
        const glm::vec3 apart = again.origin - read.origin;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 3; ++r)
                EXPECT_NEAR(seen.transform[c][r] + (c == 3 ? apart[r] : 0.0f), view.transform[c][r],
                            1e-6)
                    << far;
    }
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
    const Json json = lit(dense);
    for (const Json& material : json["materials"])
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
            write_scene_glb(folder_ / "scene.glb", load_gltf_document(read.path), read, atlas, map,
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

TEST_F(TwoQuads, SceneBakedHasOnlyTheAttributesThatShow)
{
    Json json = file();
    json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 64}});
    json["accessors"].push_back(
        {{"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC4"}});
    Json& primitive = json["meshes"][0]["primitives"][0];
    for (const char* name : {"TANGENT", "COLOR_0", "_OWN"})
        primitive["attributes"][name] = 2;
    const auto attributes_of = [](const Json& written) {
        std::set<std::string> names;
        const Json& node = written["nodes"][0];
        for (const auto& [name, accessor] :
             written["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0]["attributes"]
                 .items())
            names.insert(name);
        return names;
    };
    EXPECT_EQ(attributes_of(lit(json)),
              (std::set<std::string>{"POSITION", "TANGENT", "COLOR_0", "_OWN", "TEXCOORD_0",
                                     "TEXCOORD_1"}));
    const Json opaque = baked(json);
    EXPECT_EQ(attributes_of(opaque),
              (std::set<std::string>{"POSITION", "_OWN", "TEXCOORD_0", "TEXCOORD_1"}));
    const Json& plain =
        opaque["meshes"][opaque["nodes"][0]["mesh"].get<std::size_t>()]["primitives"][0];
    EXPECT_EQ(plain["attributes"]["TEXCOORD_0"], plain["attributes"]["TEXCOORD_1"]);
    // Colours and textures have alpha.
    json["materials"][0]["alphaMode"] = "MASK";
    const Json cut = baked(json);
    EXPECT_EQ(attributes_of(cut),
              (std::set<std::string>{"POSITION", "_OWN", "COLOR_0", "TEXCOORD_0", "TEXCOORD_1"}));
    const Json& read = cut["meshes"][cut["nodes"][0]["mesh"].get<std::size_t>()]["primitives"][0];
    EXPECT_NE(read["attributes"]["TEXCOORD_0"], read["attributes"]["TEXCOORD_1"]);
}

TEST_F(TwoQuads, WithoutAFormatNoMapIsInTheFile)
{
    const Scene read = scene(file());
    const Atlas atlas = test::corner_atlas(read);
    write_scene_glb(folder_ / "scene.glb", load_gltf_document(read.path), read, atlas,
                    test::any_map(atlas), {.format = LightmapFormat::none});
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
    write_scene_glb(folder_ / "scene.glb", load_gltf_document(before.path), before, atlas,
                    test::any_map(atlas));
    const Scene after = read_gltf(folder_ / "scene.glb");
    for (const Surface& surface : atlas.surfaces) {
        const Primitive& old = test::primitive_of(before, surface);
        const Primitive& now = test::primitive_of(after, surface);
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
    write_scene_glb(folder_ / "again.glb", load_gltf_document(after.path), after, again,
                    test::any_map(again));
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
    write_scene_glb(folder_ / "again.glb", load_gltf_document(again.path), again, atlas,
                    test::any_map(atlas));
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
    EXPECT_THROW(write_scene_glb(folder_ / "scene.glb", load_gltf_document(before.path), before,
                                 atlas, test::any_map(atlas)),
                 Error);
}

}  // namespace
}  // namespace lumel
