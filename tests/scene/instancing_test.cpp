// EXT_mesh_gpu_instancing against the same nodes written out.

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "gltf_builder.h"
#include "twins.h"

using namespace lumel;
using namespace lumel::test;

namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

const std::vector<glm::vec3> kPlaces = {{0, 0, 0}, {2, 0.1f, 0}, {4, 0, -1}};
const std::vector<glm::vec4> kTurns = {{0, 0, 0, 1}, {0, 0.6f, 0, 0.8f}, {0.5f, 0.5f, 0.5f, 0.5f}};
const std::vector<glm::vec3> kScales = {{1, 1, 1}, {2, 1, 0.3f}, {1, -1, 1}};

/// The triangle on a node that has a place of its own.
GltfBuilder placed_triangle()
{
    GltfBuilder builder = one_triangle();
    builder.json["nodes"][0]["translation"] = {1, 2, 3};
    builder.json["nodes"][0]["name"] = "leaf";
    return builder;
}

Json& attributes_of(GltfBuilder& builder)
{
    return builder.json["nodes"][0]["extensions"][kInstancing]["attributes"];
}

GltfBuilder crowd()
{
    GltfBuilder builder = placed_triangle();
    const int places = builder.add_accessor(kPlaces, "VEC3", 5126, 3);
    const int turns = builder.add_accessor(kTurns, "VEC4", 5126, 3);
    const int scales = builder.add_accessor(kScales, "VEC3", 5126, 3);
    attributes_of(builder) = {{"TRANSLATION", places}, {"ROTATION", turns}, {"SCALE", scales}};
    builder.json["extensionsUsed"] = {kInstancing};
    builder.json["extensionsRequired"] = {kInstancing};
    return builder;
}

/// The same with a node for each instance.
GltfBuilder written_out()
{
    GltfBuilder builder = placed_triangle();
    builder.json["nodes"][0].erase("mesh");
    for (std::size_t i = 0; i < kPlaces.size(); ++i) {
        const glm::vec3 t = kPlaces[i], s = kScales[i];
        const glm::vec4 r = kTurns[i];
        const int node = builder.push("nodes", {{"mesh", 0},
                                                {"translation", {t.x, t.y, t.z}},
                                                {"rotation", {r.x, r.y, r.z, r.w}},
                                                {"scale", {s.x, s.y, s.z}}});
        builder.json["nodes"][0]["children"].push_back(node);
    }
    return builder;
}

std::string error_with(const char* attribute, int accessor, GltfBuilder builder = crowd())
{
    attributes_of(builder)[attribute] = accessor;
    return error_of(builder);
}

}  // namespace

TEST(Instancing, EachInstanceIsANodeOfItsOwn)
{
    const Scene scene = crowd().read();
    EXPECT_EQ(scene.hash, written_out().read().hash);
    ASSERT_EQ(scene.instances.size(), 3u);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(scene.instances[std::size_t(i)].node, i + 1);
        EXPECT_EQ(scene.instances[std::size_t(i)].name, "leaf " + std::to_string(i + 1));
    }
}

TEST(Instancing, TheDocumentIsThatOfAPlainFile)
{
    const TempFolder folder;
    const GltfDocument document = load_gltf_document(crowd().write(folder));
    EXPECT_FALSE(contains(document.json.dump(), kInstancing)) << document.json.dump();
    EXPECT_EQ(document.json["nodes"].size(), 4u);
    EXPECT_FALSE(document.json["nodes"][0].contains("mesh"));
}

TEST(Instancing, AttributesThatAreLeftOutStandForNoChange)
{
    GltfBuilder builder = crowd();
    attributes_of(builder).erase("ROTATION");
    attributes_of(builder).erase("TRANSLATION");
    const Scene scene = builder.read();
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.instances[1].transform,
              glm::mat4({2, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0.3f, 0}, {1, 2, 3, 1}));
}

TEST(Instancing, WholeNumbersAreTakenAsShares)
{
    GltfBuilder builder = crowd();
    const std::vector<std::int16_t> turns = {0, 0, 0, 32767, 0, 32767, 0, 0, 0, 0, -32767, 0};
    const std::vector<std::int8_t> bytes = {0, 0, 0, 127, 0, 127, 0, 0, 0, 0, -127, 0};
    const std::vector<std::uint8_t> scales = {255, 255, 255, 0, 51, 255, 255, 0, 255, 255, 51, 0};
    attributes_of(builder)["ROTATION"] = builder.add_accessor(turns, "VEC4", 5122, 3, true);
    const int view = builder.add_view(scales.data(), scales.size(), 4);
    attributes_of(builder)["SCALE"] = builder.push("accessors", {{"bufferView", view},
                                                                 {"componentType", 5121},
                                                                 {"normalized", true},
                                                                 {"count", 3},
                                                                 {"type", "VEC3"}});
    const Scene scene = builder.read();
    ASSERT_EQ(scene.instances.size(), 3u);
    // Half a turn about y, of what is a fifth along x.
    const glm::mat4& second = scene.instances[1].transform;
    EXPECT_NEAR(glm::distance(second[0], glm::vec4(-0.2f, 0, 0, 0)), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::distance(second[3], glm::vec4(3, 2.1f, 3, 1)), 0.0f, 1e-6f);
    attributes_of(builder)["ROTATION"] = builder.add_accessor(bytes, "VEC4", 5120, 3, true);
    EXPECT_EQ(builder.read().hash, scene.hash);
}

TEST(Instancing, ADensityOfTheNodeIsThatOfItsInstances)
{
    GltfBuilder builder = crowd();
    builder.json["nodes"][0]["extras"]["lumel"]["texels_per_metre"] = 7;
    for (const Instance& instance : builder.read().instances)
        EXPECT_EQ(instance.texels_per_metre, 7.0f);
}

TEST(Instancing, ANodeWithoutAMeshShowsNothing)
{
    GltfBuilder builder = crowd();
    builder.json["nodes"][0].erase("mesh");
    const int other = builder.push("nodes", {{"mesh", 0}});
    builder.json["scenes"][0]["nodes"].push_back(other);
    EXPECT_EQ(builder.read().instances.size(), 1u);
}

TEST(Instancing, WhatIsWrongIsSaidWithItsPlace)
{
    const auto expect = [](const std::string& error, const std::string& what) {
        EXPECT_TRUE(contains(error, std::string("/nodes/0/extensions/") + kInstancing)) << error;
        EXPECT_TRUE(contains(error, what)) << error;
    };
    expect(error_with("SCALE", 9), "accessors[9]");
    expect(error_with("SCALE", 2), "accessor of VEC4, but needs VEC3");
    GltfBuilder lengths = crowd();
    const int two = lengths.add_accessor(kPlaces, "VEC3", 5126, 2);
    expect(error_with("SCALE", two, lengths), "has 2 instances, but another attribute has 3");
    GltfBuilder whole = crowd();
    const int plain = whole.add_accessor<std::int16_t>({1, 2, 3, 0}, "VEC4", 5122, 1);
    expect(error_with("ROTATION", plain, whole), "not normalized");
    GltfBuilder wide = crowd();
    const int turns =
        wide.add_accessor<glm::vec4>({{0, 0, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}}, "VEC4", 5126, 3);
    expect(error_with("ROTATION", turns, wide), "not a unit quaternion at instance 2");
    GltfBuilder endless = crowd();
    const int places =
        endless.add_accessor<glm::vec3>({{0, 0, 0}, {0, INFINITY, 0}, {0, 0, 0}}, "VEC3", 5126, 3);
    expect(error_with("TRANSLATION", places, endless), "not finite at instance 1");
    GltfBuilder empty = crowd();
    const int zeros =
        empty.push("accessors", {{"componentType", 5126}, {"count", 1 << 24}, {"type", "VEC3"}});
    expect(error_with("SCALE", zeros, empty), "without data");
    GltfBuilder none = crowd();
    attributes_of(none) = Json::object();
    expect(error_of(none), "has no TRANSLATION, ROTATION or SCALE");
}

TEST(Instancing, FilesOfOtherToolsShowTheirInstances)
{
    const auto path = [](const std::string& name) {
        return support::data_path("gltf_conformance/" + name);
    };
    if (!std::filesystem::exists(path("selfmade/gpu_instancing_room.glb")))
        GTEST_SKIP() << "the test data is absent";
    EXPECT_EQ(read_gltf(path("selfmade/gpu_instancing_room.glb")).instances.size(), 2u + 9u);
    const std::string teapots =
        "khronos_spec_samples/EXT_mesh_gpu_instancing/samples/teapots_galore";
    EXPECT_EQ(read_gltf(path(teapots + "/teapots_galore.gltf")).instances.size(), 958u + 941u + 1u);
}
