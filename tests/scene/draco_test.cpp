// KHR_draco_mesh_compression: files made with the library's own encoder, and those of other tools.

#include <cmath>

#include <gtest/gtest.h>

#include "../support/source_folder.h"
#include "compressed_file.h"
#include "twins.h"

using namespace lumel;
using namespace lumel::test;

namespace {

constexpr DracoWay kInOrder = {.edgebreaker = false};

Json& primitive_of(GltfBuilder& builder)
{
    return builder.json["meshes"][0]["primitives"][0];
}

Json& extension_of(GltfBuilder& builder)
{
    return primitive_of(builder)["extensions"]["KHR_draco_mesh_compression"];
}

/// How far off normals of so many bits are. Of a vector with |x| + |y| + |z| = 1, two coordinates
/// are rounded to steps of 1 / (2^(bits - 1) - 1), half of one away, and the third makes up for
/// both: sqrt(1.5) steps. Such a vector is as short as 1 / sqrt(3).
float normal_step(int bits)
{
    return std::sqrt(1.5f) * std::sqrt(3.0f) / float((1 << (bits - 1)) - 1);
}

/// What is wrong with the wave once its extension is changed.
template <class Change>
std::string error_with(const Change& change)
{
    GltfBuilder builder = draco_wave({});
    change(builder);
    return error_of(builder);
}

}  // namespace

TEST(Draco, ExactStreamsAreThePlainFile)
{
    const Scene plain = RayBatch().plain().read();
    EXPECT_EQ(draco_wave(kInOrder).read().hash, plain.hash);
    expect_twins(plain, draco_wave({}).read(), {});
}

TEST(Draco, QuantisedOnesEndWithinTheirSteps)
{
    // Positions: half a step of the widest side, 1, in each of three directions.
    expect_twins(RayBatch().plain().read(),
                 draco_wave({.position_bits = 12, .normal_bits = 8}).read(),
                 {.position = 0.87f / 4095.0f, .normal = normal_step(8), .texcoord = 0.0f});
}

TEST(Draco, TheDocumentIsThatOfAPlainFile)
{
    const TempFolder folder;
    const GltfDocument document = load_gltf_document(draco_wave({}).write(folder));
    EXPECT_FALSE(contains(document.json.dump(), "draco")) << document.json.dump();
    for (const char* key : {"extensionsUsed", "extensionsRequired"})
        EXPECT_FALSE(document.json.contains(key));
    // Nor is the stream in it: its place has the indices.
    EXPECT_EQ(document.json["accessors"][3]["bufferView"], 0);
}

TEST(Draco, PrimitivesThatShareAccessorsGetTheirOwnData)
{
    GltfBuilder builder = draco_wave(kInOrder);
    GltfBuilder half = draco_wave({.edgebreaker = false, .position_bits = 4});
    const int view = builder.add_view(half.buffer.data(), half.buffer.size());
    Json second = primitive_of(builder);
    second["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = view;
    builder.json["meshes"][0]["primitives"].push_back(second);
    builder.json["meshes"][0]["primitives"].push_back(primitive_of(builder));
    const Scene scene = builder.read();
    const auto& primitives = scene.meshes.at(0).primitives;
    ASSERT_EQ(primitives.size(), 3u);
    const Scene plain = RayBatch().plain().read();
    const auto& expected = plain.meshes[0].primitives[0].positions;
    EXPECT_EQ(primitives[0].positions, expected);
    EXPECT_EQ(primitives[1].positions, half.read().meshes[0].primitives[0].positions);
    EXPECT_NE(primitives[1].positions, expected);
    EXPECT_EQ(primitives[2].positions, expected);
}

TEST(Draco, StripsAreListsOnceDecoded)
{
    GltfBuilder builder = draco_wave(kInOrder);
    primitive_of(builder)["mode"] = 5;
    EXPECT_EQ(builder.read().hash, RayBatch().plain().read().hash);
}

TEST(Draco, WhatIsWrongIsSaidWithItsPlace)
{
    const auto expect = [](const std::string& error, const std::string& place,
                           const std::string& what) {
        EXPECT_TRUE(contains(error, place)) << error;
        EXPECT_TRUE(contains(error, what)) << error;
    };
    const std::string view = "KHR_draco_mesh_compression/bufferView";
    expect(error_with([](GltfBuilder& b) { extension_of(b)["bufferView"] = 7; }), view,
           "bufferViews[7]");
    expect(error_with([](GltfBuilder& b) { extension_of(b)["attributes"]["NORMAL"] = 9; }),
           "attributes/NORMAL", "has no such attribute");
    expect(error_with([](GltfBuilder& b) { extension_of(b)["attributes"]["COLOR_0"] = 0; }),
           "/attributes", "COLOR_0");
    expect(error_with([](GltfBuilder& b) { primitive_of(b)["mode"] = 6; }), "/mode",
           "only holds triangles");
    expect(error_with([](GltfBuilder& b) { b.json["accessors"][1]["type"] = "VEC2"; }),
           "/accessors/1/type", "Draco");
    expect(error_with([](GltfBuilder& b) { b.json["accessors"][1]["componentType"] = 5123; }),
           "/accessors/1/componentType", "Draco");
    expect(error_with([](GltfBuilder& b) { b.buffer[0] = 'X'; }), view, "is no Draco data");
    expect(error_with([](GltfBuilder& b) { b.buffer[6] = 1; }), view, "only 2.2 is read");
    expect(error_with([](GltfBuilder& b) { b.buffer[7] = 0; }), view, "no mesh");
    expect(error_with([](GltfBuilder& b) { b.buffer[8] = 5; }), view, "broken");
    expect(error_with([](GltfBuilder& b) { b.json["bufferViews"][0]["byteLength"] = 60; }), view,
           "broken");
}

TEST(Draco, AFewBytesCannotClaimGigabytes)
{
    // Of a stream that was found by others: 93 vertices and 2 million faces in 61 bytes, and more.
    for (const std::uint8_t high : Bytes{0x04, 0x7F}) {
        const Bytes stream = {'D',  'R',  'A',  'C',  'O',  2, 2,    1,    1,    0,    0, 0,
                              0x5D, 0x80, 0x80, 0x80, high, 0, 0x80, 0x80, 0x80, high, 0};
        GltfBuilder builder = draco_wave({});
        builder.json["bufferViews"] = Json::array();
        builder.buffer.clear();
        builder.add_view(stream.data(), stream.size());
        const std::string error = error_of(builder);
        EXPECT_TRUE(contains(error, "far more triangles than its 23 bytes")) << error;
    }
}

TEST(Draco, FilesOfOtherToolsAreTheirPlainTwins)
{
    const auto path = [](const char* name) {
        return support::data_path(std::string("gltf_conformance/") + name);
    };
    if (!std::filesystem::exists(path("compressed/room_draco.glb")))
        GTEST_SKIP() << "the test data is absent";
    // A room 4 m wide at 14 bits, its normals at 10, texture coordinates at 12 (gltf-transform).
    expect_twins(read_gltf(path("selfmade/texture_webp.glb")),
                 read_gltf(path("compressed/room_draco.glb")),
                 {.position = 0.87f * 4.0f / 16383.0f,
                  .normal = normal_step(10),
                  .texcoord = 1.0f / 4095.0f});
    const Scene packed = read_gltf(path("compressed/classroom_draco.glb"));
    const Scene plain =
        read_gltf(support::data_path("interiors/japanese_classroom/japanese_classroom.glb"));
    EXPECT_EQ(packed.instances.size(), plain.instances.size());
    EXPECT_NEAR(area_of(packed), area_of(plain), 1e-3 * area_of(plain));
}

TEST(Draco, SponzaHasItsTrianglesAndItsArea)
{
    const std::string path = support::data_path("crytek_sponza/sponza_draco_webp.glb");
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << "the test data is absent";
    const Scene packed = read_gltf(path);
    const Scene plain = read_gltf(support::data_path("crytek_sponza/sponza.glb"));
    EXPECT_EQ(packed.instances.size(), plain.instances.size());
    EXPECT_EQ(packed.textures.size(), plain.textures.size());
    EXPECT_NEAR(area_of(packed), area_of(plain), 1e-3 * area_of(plain));
}
