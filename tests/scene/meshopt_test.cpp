// EXT_meshopt_compression: files made with the library's own encoder, and those of other tools.

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "../support/source_folder.h"
#include "compressed_file.h"
#include "twins.h"

using namespace lumel;
using namespace lumel::test;

namespace {

/// Puts a coded bufferView in the place of a plain one, whose data a second buffer would have.
void code_view(GltfBuilder& builder, std::size_t view, const Bytes& coded, Json extension,
               const char* name = "EXT_meshopt_compression")
{
    const int stored = builder.add_view(coded.data(), coded.size());
    const Json place = builder.json["bufferViews"][std::size_t(stored)];
    builder.json["bufferViews"].erase(std::size_t(stored));
    for (const char* key : {"buffer", "byteOffset", "byteLength"})
        extension[key] = place[key];
    Json& target = builder.json["bufferViews"][view];
    const std::size_t length =
        extension["count"].get<std::size_t>() * extension["byteStride"].get<std::size_t>();
    target = {{"buffer", 1}, {"byteOffset", 8}, {"byteLength", length}};
    if (extension["mode"] == "ATTRIBUTES")
        target["byteStride"] = extension["byteStride"];
    target["extensions"][name] = extension;
    builder.json["buffers"][0]["byteLength"] = builder.buffer.size();
}

/// Codes vectors of three floats that share an exponent, the only mode before meshoptimizer 0.19.
void encode_exponential(void* coded, std::size_t count, int bits, const float* values)
{
#if MESHOPTIMIZER_VERSION >= 190
    meshopt_encodeFilterExp(coded, count, 12, bits, values, meshopt_EncodeExpSharedVector);
#else
    meshopt_encodeFilterExp(coded, count, 12, bits, values);
#endif
}

Bytes coded_vertices(const void* data, std::size_t count, std::size_t stride)
{
    Bytes bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), data, count, stride));
    return bytes;
}

Json attributes(std::size_t count, std::size_t stride, const char* filter = "NONE")
{
    return {{"mode", "ATTRIBUTES"}, {"count", count}, {"byteStride", stride}, {"filter", filter}};
}

/// The wave with all its vertices coded without loss.
GltfBuilder coded_wave(const char* name = "EXT_meshopt_compression")
{
    const RayBatch wave;
    GltfBuilder builder = wave.plain();
    builder.json["buffers"] = Json::array({{{"byteLength", 0}}, {{"byteLength", 1 << 30}}});
    const std::size_t count = wave.positions.size();
    code_view(builder, 0, coded_vertices(wave.positions.data(), count, 12), attributes(count, 12),
              name);
    code_view(builder, 1, coded_vertices(wave.normals.data(), count, 12), attributes(count, 12),
              name);
    code_view(builder, 2, coded_vertices(wave.texcoords.data(), count, 8), attributes(count, 8),
              name);
    builder.json["buffers"][1]["extensions"][name]["fallback"] = true;
    builder.json["extensionsUsed"] = {name};
    builder.json["extensionsRequired"] = {name};
    return builder;
}

Bytes coded_indices(const RayBatch& wave)
{
    Bytes bytes(meshopt_encodeIndexBufferBound(wave.indices.size(), wave.positions.size()));
    bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), wave.indices.data(),
                                           wave.indices.size()));
    return bytes;
}

Json& extension_of(GltfBuilder& builder, std::size_t view)
{
    return builder.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

}  // namespace

TEST(Meshopt, CodedVerticesAreThoseOfThePlainFile)
{
    const std::string plain = RayBatch().plain().read().hash;
    EXPECT_EQ(coded_wave().read().hash, plain);
    EXPECT_EQ(coded_wave("KHR_meshopt_compression").read().hash, plain);
}

TEST(Meshopt, IndicesKeepTheirOrderAndTrianglesTheirCorners)
{
    const RayBatch wave;
    const Scene plain = wave.plain().read();
    GltfBuilder sequence = coded_wave();
    Bytes bytes(meshopt_encodeIndexSequenceBound(wave.indices.size(), wave.positions.size()));
    bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), wave.indices.data(),
                                             wave.indices.size()));
    code_view(sequence, 3, bytes,
              {{"mode", "INDICES"}, {"count", wave.indices.size()}, {"byteStride", 2}});
    EXPECT_EQ(sequence.read().hash, plain.hash);

    GltfBuilder triangles = coded_wave();
    code_view(triangles, 3, coded_indices(wave),
              {{"mode", "TRIANGLES"}, {"count", wave.indices.size()}, {"byteStride", 2}});
    expect_twins(plain, triangles.read(), {});
}

TEST(Meshopt, FiltersEndWithinTheirSteps)
{
    const RayBatch wave;
    const std::size_t count = wave.positions.size();
    constexpr int kBits = 15;  // of the mantissa of positions, one of them its sign
    GltfBuilder builder = coded_wave();
    std::vector<std::uint32_t> positions(count * 3);
    encode_exponential(positions.data(), count, kBits, &wave.positions[0].x);
    code_view(builder, 0, coded_vertices(positions.data(), count, 12),
              attributes(count, 12, "EXPONENTIAL"));

    std::vector<glm::vec4> wide;
    for (const glm::vec3& normal : wave.normals)
        wide.emplace_back(normal, 0.0f);
    std::vector<std::int8_t> normals(count * 4);
    meshopt_encodeFilterOct(normals.data(), count, 4, 8, &wide[0].x);
    code_view(builder, 1, coded_vertices(normals.data(), count, 4),
              attributes(count, 4, "OCTAHEDRAL"));
    builder.json["accessors"][1]["componentType"] = 5120;
    builder.json["accessors"][1]["normalized"] = true;
    builder.json["extensionsUsed"].push_back("KHR_mesh_quantization");

    // A vertex with a 1 in it has the exponent of [1, 2): its steps are 2 / 2^14, and it is half of
    // one away in each of three directions. Normals: half of 1/127 in the octahedron and again in
    // the decoded bytes, in three directions each, on a face that is slanted by sqrt(3) at most.
    expect_twins(
        wave.plain().read(), builder.read(),
        {.position = 0.87f * 2.0f / 16384.0f, .normal = 2.0f * 1.74f / 127.0f, .texcoord = 0.0f});
}

TEST(Meshopt, TurnsOfQuaternionsAreThoseThatWereCoded)
{
    // Read as vertex colours, which are four normalised numbers too.
    const glm::vec4 turn = glm::normalize(glm::vec4(0.1f, 0.2f, 0.3f, 0.9f));
    GltfBuilder builder = coded_wave();
    std::vector<glm::vec4> turns(16, turn);
    std::vector<std::int16_t> coded(turns.size() * 4);
    meshopt_encodeFilterQuat(coded.data(), turns.size(), 8, 16, &turns[0].x);
    const int view = builder.add_view(coded.data(), coded.size() * 2, 8);
    code_view(builder, std::size_t(view), coded_vertices(coded.data(), turns.size(), 8),
              attributes(turns.size(), 8, "QUATERNION"));
    const int accessor = builder.push("accessors", {{"bufferView", view},
                                                    {"componentType", 5122},
                                                    {"normalized", true},
                                                    {"count", turns.size()},
                                                    {"type", "VEC4"}});
    const TempFolder folder;
    const AccessorData data =
        read_accessor(load_gltf_document(builder.write(folder)), std::size_t(accessor));
    for (std::size_t i = 0; i < turns.size() * 4; ++i) {
        std::int16_t value;
        std::memcpy(&value, &data.bytes[i * 2], 2);
        EXPECT_NEAR(float(value) / 32767.0f, turn[int(i % 4)], 2.0f / 32767.0f);
    }
}

TEST(Meshopt, TheDocumentIsThatOfAPlainFile)
{
    const TempFolder folder;
    const GltfDocument document = load_gltf_document(coded_wave().write(folder));
    EXPECT_FALSE(contains(document.json.dump(), "meshopt")) << document.json.dump();
    for (const char* key : {"extensionsUsed", "extensionsRequired"})
        EXPECT_FALSE(document.json.contains(key));
}

TEST(Meshopt, WhatIsWrongIsSaidWithItsPlace)
{
    const auto error_with = [](std::size_t view, const char* key, const Json& value) {
        GltfBuilder builder = coded_wave();
        extension_of(builder, view)[key] = value;
        return error_of(builder);
    };
    const std::string place = "/bufferViews/0/extensions/EXT_meshopt_compression";
    const auto expect = [&](const char* key, const Json& value, const std::string& what) {
        const std::string error = error_with(0, key, value);
        EXPECT_TRUE(contains(error, place)) << error;
        EXPECT_TRUE(contains(error, what)) << error;
    };
    expect("buffer", 9, "buffers[9]");
    expect("buffer", 1, "which has 0 bytes");
    expect("byteLength", 1 << 20, "reaches byte");
    expect("byteLength", 60, "is broken");
    expect("mode", "POINTS", "must be ATTRIBUTES, TRIANGLES or INDICES");
    expect("mode", "TRIANGLES", "/byteStride: is 12");
    expect("filter", "COLOR", "which is not read");
    expect("filter", "OCTAHEDRAL", "/byteStride: is 12");
    expect("filter", "QUATERNION", "/byteStride: is 12");
    expect("byteStride", 10, "/byteStride: is 10");
    expect("byteStride", 260, "/byteStride: is 260");
    expect("count", 1 << 30, "can hold");
    EXPECT_TRUE(contains(error_with(0, "count", 80), "/bufferViews/0/byteLength: must be"));

    const RayBatch wave;
    GltfBuilder triangles = coded_wave();
    code_view(triangles, 3, coded_indices(wave),
              {{"mode", "TRIANGLES"}, {"count", wave.indices.size()}, {"byteStride", 2}});
    extension_of(triangles, 3)["count"] = wave.indices.size() - 1;
    EXPECT_TRUE(contains(error_of(triangles), "no whole triangles"));
    extension_of(triangles, 3)["count"] = 3 * wave.indices.size() * 100;
    EXPECT_TRUE(contains(error_of(triangles), "can hold"));

    GltfBuilder newer = coded_wave();
    newer.buffer[extension_of(newer, 0)["byteOffset"].get<std::size_t>()] = 0xA1;
    EXPECT_TRUE(contains(error_of(newer), "version 1"));

    GltfBuilder plain_view = coded_wave();
    plain_view.json["bufferViews"][0].erase("extensions");
    EXPECT_TRUE(contains(error_of(plain_view), "which has 0 bytes"));
}

TEST(Meshopt, AClassroomHasTheObjectsAndTheAreaOfItsPlainFile)
{
    const std::string plain =
        support::data_path("interiors/japanese_classroom/japanese_classroom.glb");
    const std::string packed =
        support::data_path("gltf_conformance/compressed/classroom_meshopt.glb");
    if (!std::filesystem::exists(packed))
        GTEST_SKIP() << "the test data is absent";
    const Scene scene = read_gltf(packed);
    ASSERT_FALSE(scene.instances.empty());
    const Scene original = read_gltf(plain);
    EXPECT_EQ(scene.instances.size(), original.instances.size());
    EXPECT_NEAR(area_of(scene), area_of(original), 1e-3 * area_of(original));
}
