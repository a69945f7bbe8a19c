// Geometry of glTF meshes as triangle lists.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gltf_builder.h"

using namespace lumel;
using namespace lumel::test;

namespace {

const std::vector<glm::vec3> kQuad = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};

const Primitive& first_primitive(const Scene& scene)
{
    return scene.meshes.at(0).primitives.at(0);
}

/// Normal of a triangle by its winding, unit length.
glm::vec3 winding_normal(const Primitive& primitive, std::size_t triangle)
{
    const std::uint32_t* i = &primitive.indices.at(3 * triangle);
    const glm::vec3 a = primitive.positions.at(i[0]);
    return glm::normalize(
        glm::cross(primitive.positions.at(i[1]) - a, primitive.positions.at(i[2]) - a));
}

GltfBuilder quad_with_mode(int mode, const std::vector<glm::vec3>& positions)
{
    GltfBuilder builder;
    builder.add_positions(positions);
    builder.show({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
    return builder;
}

template <typename T>
std::vector<std::uint32_t> indices_read(int component_type, const std::vector<T>& indices)
{
    GltfBuilder builder;
    builder.add_positions(kQuad);
    builder.add_accessor(indices, "SCALAR", component_type, indices.size());
    builder.show({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
    return first_primitive(builder.read()).indices;
}

}  // namespace

TEST(Geometry, UnindexedVerticesBecomeTrianglesInOrder)
{
    const Scene scene = one_triangle().read();
    EXPECT_EQ(first_primitive(scene).indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(first_primitive(scene).normals.empty());
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(Geometry, IndicesOfEveryTypeAreRead)
{
    const std::vector<std::uint32_t> expected = {0, 1, 2, 2, 1, 3};
    EXPECT_EQ(indices_read<std::uint8_t>(5121, {0, 1, 2, 2, 1, 3}), expected);
    EXPECT_EQ(indices_read<std::uint16_t>(5123, {0, 1, 2, 2, 1, 3}), expected);
    EXPECT_EQ(indices_read<std::uint32_t>(5125, {0, 1, 2, 2, 1, 3}), expected);
}

TEST(Geometry, StripsKeepOneWinding)
{
    const Scene scene = quad_with_mode(5, kQuad).read();
    ASSERT_EQ(first_primitive(scene).indices.size(), 6u);
    for (std::size_t t : {0u, 1u})
        EXPECT_NEAR(winding_normal(first_primitive(scene), t).z, 1.0f, 1e-6f);
}

TEST(Geometry, FansKeepOneWinding)
{
    const Scene scene = quad_with_mode(6, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).read();
    ASSERT_EQ(first_primitive(scene).indices.size(), 6u);
    for (std::size_t t : {0u, 1u})
        EXPECT_NEAR(winding_normal(first_primitive(scene), t).z, 1.0f, 1e-6f);
}

TEST(Geometry, PointsAndLinesAreSkippedWithAWarning)
{
    GltfBuilder builder = one_triangle();
    builder.json["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
    const Scene scene = builder.read();
    EXPECT_EQ(scene.meshes[0].primitives.size(), 1u);
    EXPECT_TRUE(warns(scene, "points or lines"));
}

TEST(Geometry, AFileWithoutTrianglesIsAnError)
{
    EXPECT_TRUE(contains(error_of(quad_with_mode(0, kQuad)), "no triangles"));
    EXPECT_TRUE(contains(error_of(GltfBuilder{}), "no triangles"));
}

TEST(Geometry, ZeroAreaTrianglesAreDroppedAndCounted)
{
    GltfBuilder builder;
    builder.add_positions({{0, 0, 0},
                           {1, 0, 0},
                           {0, 1, 0},
                           {0, 0, 0},
                           {1, 1, 1},
                           {2, 2, 2},
                           {5, 5, 5},
                           {5, 5, 5},
                           {0, 0, 0}});
    builder.show({{"attributes", {{"POSITION", 0}}}});
    const Scene scene = builder.read();
    EXPECT_EQ(first_primitive(scene).indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(scene.dropped_triangles, 2u);
    EXPECT_TRUE(warns(scene, "2 triangles of zero area"));
}

TEST(Geometry, ThinButRealTrianglesAreKept)
{
    GltfBuilder builder;
    builder.add_positions({{0, 0, 0}, {10, 0, 0}, {0, 1e-4f, 0}});
    builder.show({{"attributes", {{"POSITION", 0}}}});
    EXPECT_EQ(builder.read().dropped_triangles, 0u);
}

TEST(Geometry, LeftOverIndicesAreIgnoredWithAWarning)
{
    const Scene scene = quad_with_mode(4, kQuad).read();
    EXPECT_EQ(first_primitive(scene).indices.size(), 3u);
    EXPECT_TRUE(warns(scene, "left over"));
}

TEST(Geometry, InterleavedAttributesAreSeparated)
{
    GltfBuilder builder;
    struct Vertex {
        glm::vec3 position;
        glm::vec2 texcoord;
    };
    const std::vector<Vertex> vertices = {
        {{0, 0, 0}, {0.25f, 0}}, {{1, 0, 0}, {0.5f, 1}}, {{0, 1, 0}, {0.75f, 0}}};
    builder.add_view(vertices.data(), vertices.size() * sizeof(Vertex), sizeof(Vertex));
    builder.push("accessors",
                 {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    builder.push("accessors", {{"bufferView", 0},
                               {"byteOffset", 12},
                               {"componentType", 5126},
                               {"count", 3},
                               {"type", "VEC2"}});
    builder.show({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}});
    const Scene scene = builder.read();
    EXPECT_EQ(first_primitive(scene).positions[2], glm::vec3(0, 1, 0));
    EXPECT_EQ(first_primitive(scene).texcoords[0][1], glm::vec2(0.5f, 1));
}

TEST(Geometry, SparseValuesReplaceThoseOfTheAccessor)
{
    GltfBuilder builder = one_triangle();
    const glm::vec3 value(0, 7, 0);
    builder.replace_sparsely(2, value);
    EXPECT_EQ(first_primitive(builder.read()).positions[2], value);
}

TEST(Geometry, SparseIndicesOutOfRangeAreAnError)
{
    GltfBuilder builder = one_triangle();
    builder.replace_sparsely(3, glm::vec3(0, 7, 0));
    EXPECT_TRUE(contains(error_of(builder), "/accessors/0/sparse/indices: index 0 is 3"));
}

TEST(Geometry, QuantizedPositionsAndNormalsAreDecoded)
{
    GltfBuilder builder;
    builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    const std::vector<std::int16_t> positions = {-32768, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0};
    const int view = builder.add_view(positions.data(), positions.size() * 2, 8);
    builder.push("accessors", {{"bufferView", view},
                               {"componentType", 5122},
                               {"count", 3},
                               {"type", "VEC3"},
                               {"normalized", true}});
    const std::vector<std::int8_t> normals = {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0};
    const int normal_view = builder.add_view(normals.data(), normals.size(), 4);
    builder.push("accessors", {{"bufferView", normal_view},
                               {"componentType", 5120},
                               {"count", 3},
                               {"type", "VEC3"},
                               {"normalized", true}});
    builder.show({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}});
    const Scene scene = builder.read();
    EXPECT_EQ(first_primitive(scene).positions[0], glm::vec3(-1, 0, 0));
    EXPECT_EQ(first_primitive(scene).positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(first_primitive(scene).normals[0], glm::vec3(0, 0, 1));

    builder.json.erase("extensionsUsed");
    EXPECT_TRUE(contains(error_of(builder), "KHR_mesh_quantization"));
}

TEST(Geometry, UnnormalizedQuantizedPositionsAreWholeNumbers)
{
    GltfBuilder builder;
    builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    const std::vector<std::uint8_t> positions = {0, 0, 0, 0, 200, 0, 0, 0, 0, 100, 0, 0};
    const int view = builder.add_view(positions.data(), positions.size(), 4);
    builder.push("accessors",
                 {{"bufferView", view}, {"componentType", 5121}, {"count", 3}, {"type", "VEC3"}});
    builder.show({{"attributes", {{"POSITION", 0}}}});
    EXPECT_EQ(first_primitive(builder.read()).positions[1], glm::vec3(200, 0, 0));
}

TEST(Geometry, ColoursOfEveryEncodingAreRead)
{
    GltfBuilder builder = one_triangle();
    builder.add_accessor<std::uint16_t>({65535, 0, 0, 0, 0, 65535, 0, 0, 0, 0, 65535, 0}, "VEC4",
                                        5123, 3, true);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 1;
    EXPECT_EQ(first_primitive(builder.read()).colors[1], glm::vec4(0, 1, 0, 0));

    // Three components stand for opaque.
    builder = one_triangle();
    builder.add_accessor<float>({1, 0, 0, 0, 0.5f, 0, 0, 0, 1}, "VEC3", 5126, 3);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 1;
    EXPECT_EQ(first_primitive(builder.read()).colors[1], glm::vec4(0, 0.5f, 0, 1));
}

TEST(Geometry, NormalsBecomeUnitVectorsAndBrokenOnesAreRepaired)
{
    GltfBuilder builder = one_triangle();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    builder.add_accessor<float>({0, 3, 0, 0, 0, 0, nan, 0, 0}, "VEC3", 5126, 3);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1;
    const Scene scene = builder.read();
    EXPECT_EQ(first_primitive(scene).normals[0], glm::vec3(0, 1, 0));
    EXPECT_EQ(first_primitive(scene).normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(first_primitive(scene).normals[2], glm::vec3(0, 0, 1));
    EXPECT_TRUE(warns(scene, "2 normals"));
}

TEST(Geometry, MorphTargetsAreBakedAtDefaultWeights)
{
    GltfBuilder builder = one_triangle();
    builder.add_positions({{0, 0, 0}, {2, 0, 0}, {0, 0, 0}});
    builder.json["meshes"][0]["primitives"][0]["targets"] = Json::array({{{"POSITION", 1}}});
    builder.json["meshes"][0]["weights"] = {0.5};
    const Scene scene = builder.read();
    EXPECT_EQ(first_primitive(scene).positions[1], glm::vec3(2, 0, 0));
    EXPECT_TRUE(warns(scene, "morph targets"));
}

TEST(Geometry, PositionsThatAreNoNumbersAreAnError)
{
    for (float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
        GltfBuilder builder;
        builder.add_positions({{0, 0, 0}, {1, bad, 0}, {0, 1, 0}});
        builder.show({{"attributes", {{"POSITION", 0}}}});
        EXPECT_TRUE(
            contains(error_of(builder), "/meshes/0/primitives/0/attributes/POSITION: vertex 1"));
    }
}

TEST(Geometry, TexcoordsThatAreNoNumbersAreAnError)
{
    GltfBuilder builder = one_triangle();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    builder.add_accessor<float>({0, 0, 1, nan, 0, 1}, "VEC2", 5126, 3);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 1;
    EXPECT_TRUE(contains(error_of(builder), "TEXCOORD_1: element 1 is not a number"));
}

TEST(Geometry, IndicesOutOfRangeAreAnError)
{
    GltfBuilder builder = one_triangle();
    builder.add_accessor<std::uint16_t>({0, 1, 3}, "SCALAR", 5123, 3);
    builder.json["meshes"][0]["primitives"][0]["indices"] = 1;
    EXPECT_TRUE(contains(error_of(builder),
                         "/meshes/0/primitives/0/indices: index 2 is 3, but there are 3 vertices"));
}

TEST(Geometry, PrimitiveRestartIsAnErrorEvenWithEnoughVertices)
{
    GltfBuilder builder;
    std::vector<glm::vec3> positions(256, glm::vec3(0));
    positions[1] = {1, 0, 0};
    positions[2] = {0, 1, 0};
    builder.add_positions(positions);
    builder.add_accessor<std::uint8_t>({0, 1, 255}, "SCALAR", 5121, 3);
    builder.show({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
    EXPECT_TRUE(contains(error_of(builder), "primitive restart"));
}

TEST(Geometry, AttributesOfWrongTypeOrLengthAreErrors)
{
    GltfBuilder builder = one_triangle();
    builder.add_accessor<float>({0, 0, 1, 0}, "VEC2", 5126, 2);
    auto& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_0"] = 1;
    EXPECT_TRUE(contains(error_of(builder), "TEXCOORD_0: has 2 elements, but POSITION has 3"));
    attributes["TEXCOORD_0"] = 0;
    EXPECT_TRUE(contains(error_of(builder), "accessor of type VEC3, but needs VEC2"));
    attributes.erase("TEXCOORD_0");
    attributes["POSITION"] = 9;
    EXPECT_TRUE(contains(error_of(builder), "refers to accessors[9]"));
    attributes = {{"NORMAL", 0}};
    EXPECT_TRUE(contains(error_of(builder), "has no POSITION"));
    builder.json["meshes"][0]["primitives"][0]["mode"] = 7;
    EXPECT_TRUE(contains(error_of(builder), "/meshes/0/primitives/0/mode: is 7"));
}

TEST(Geometry, CompressedPrimitivesAreReadOnlyWithPlainAccessors)
{
    GltfBuilder builder = one_triangle();
    builder.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    builder.json["meshes"][0]["primitives"][0]["extensions"] = {
        {"KHR_draco_mesh_compression", {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}}}};
    EXPECT_EQ(builder.read().instances.size(), 1u);
    builder.json["accessors"][0].erase("bufferView");
    EXPECT_TRUE(contains(error_of(builder), "KHR_draco_mesh_compression"));
}

TEST(Geometry, ContentDecidesTheHashAndNamesDoNot)
{
    GltfBuilder builder = one_triangle();
    const std::string hash = builder.read().hash;
    EXPECT_EQ(hash.size(), 16u);
    builder.json["nodes"][0]["name"] = "triangle";
    EXPECT_EQ(builder.read().hash, hash);
    builder.json["nodes"][0]["translation"] = {0, 0, 1};
    EXPECT_NE(builder.read().hash, hash);
}
