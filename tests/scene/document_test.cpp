// The low level: containers, JSON, buffers and accessors.

#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "scene/gltf/page_parts.h"
#include "scene/gltf/split_sides.h"

using namespace lumel;
using namespace lumel::test;

namespace {

/// What happens with one member of the triangle's accessor or bufferView replaced.
std::string error_with(const char* list, const char* key, const Json& value)
{
    GltfBuilder builder = one_triangle();
    builder.json[list][0][key] = value;
    return error_of(builder);
}

}  // namespace

TEST(Document, KeepsTheOrderOfMembersAndTheBytes)
{
    GltfBuilder builder = one_triangle();
    builder.json["zebra"] = 1;
    builder.json["ant"] = 2;
    const TempFolder folder;
    const GltfDocument document = load_gltf_document(builder.write(folder));
    ASSERT_EQ(document.buffers.size(), 1u);
    EXPECT_EQ(document.buffers[0], builder.buffer);
    const std::string text = document.json.dump();
    EXPECT_LT(text.find("zebra"), text.find("ant"));
}

TEST(Document, AccessorsArePackedTightly)
{
    GltfBuilder builder = one_triangle();
    const std::vector<std::uint8_t> colors = {1, 2, 3, 0, 4, 5, 6, 0};
    const int view = builder.add_view(colors.data(), colors.size(), 4);
    builder.push("accessors", {{"bufferView", view},
                               {"componentType", 5121},
                               {"count", 2},
                               {"type", "VEC3"},
                               {"normalized", true}});
    const TempFolder folder;
    const AccessorData data = read_accessor(load_gltf_document(builder.write(folder)), 1);
    EXPECT_EQ(data.bytes, (Bytes{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(data.component_type, ComponentType::u8);
    EXPECT_EQ(data.components, 3u);
    EXPECT_EQ(data.element_size, 3u);
    EXPECT_EQ(data.count, 2u);
    EXPECT_TRUE(data.normalized);
}

TEST(Document, AnAccessorWithoutDataIsZeros)
{
    GltfBuilder builder = one_triangle();
    builder.push("accessors", {{"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}});
    const TempFolder folder;
    EXPECT_EQ(read_accessor(load_gltf_document(builder.write(folder)), 1).bytes, Bytes(8, 0));
    builder.json["accessors"][1]["count"] = 1e12;
    EXPECT_TRUE(contains(error_of(builder), "/accessors/1/count"));
}

TEST(Document, LyingAccessorsAreErrors)
{
    EXPECT_TRUE(contains(error_with("accessors", "count", 4), "/accessors/0: needs 48 bytes"));
    EXPECT_TRUE(contains(error_with("accessors", "count", 0), "/accessors/0/count"));
    EXPECT_TRUE(contains(error_with("accessors", "count", 9e15), "/accessors/0/count"));
    EXPECT_TRUE(contains(error_with("accessors", "count", 1099511627776), "/accessors/0: needs"));
    EXPECT_TRUE(contains(error_with("accessors", "count", "3"), "must be a whole number"));
    EXPECT_TRUE(contains(error_with("accessors", "count", 2.5), "must be a whole number"));
    EXPECT_TRUE(contains(error_with("accessors", "byteOffset", -4), "/accessors/0/byteOffset"));
    EXPECT_TRUE(contains(error_with("accessors", "byteOffset", 1), "/accessors/0: needs 37 bytes"));
    EXPECT_TRUE(contains(error_with("accessors", "bufferView", 1), "bufferViews[1]"));
    EXPECT_TRUE(contains(error_with("accessors", "componentType", 5124), "no glTF component type"));
    EXPECT_TRUE(contains(error_with("accessors", "type", "VEC5"), "no glTF element type"));
    EXPECT_TRUE(contains(error_with("accessors", "normalized", 1), "true or false"));
    EXPECT_TRUE(contains(error_with("accessors", "sparse", 1), "must be a JSON object"));
}

TEST(Document, LyingBufferViewsAreErrors)
{
    EXPECT_TRUE(contains(error_with("bufferViews", "byteLength", 40), "/bufferViews/0: reaches"));
    EXPECT_TRUE(contains(error_with("bufferViews", "byteOffset", 4), "/bufferViews/0: reaches"));
    EXPECT_TRUE(contains(error_with("bufferViews", "buffer", 1), "buffers[1]"));
    EXPECT_TRUE(contains(error_with("bufferViews", "byteStride", 8), "byteStride of 8"));
    EXPECT_TRUE(contains(error_with("bufferViews", "byteStride", 256), "byteStride: is 256"));
    EXPECT_TRUE(contains(error_with("bufferViews", "byteStride", 18), "multiple of 4"));
    EXPECT_TRUE(contains(error_with("buffers", "byteLength", 1000), "/buffers/0: should hold"));
}

TEST(Document, RequiredExtensionsThatAreUnknownAreNamed)
{
    for (const char* name : {"VENDOR_magic", "KHR_texture_basisu", "EXT_mesh_manifold"}) {
        GltfBuilder builder = one_triangle();
        builder.json["extensionsRequired"] = {"KHR_mesh_quantization", name};
        const std::string error = error_of(builder);
        EXPECT_TRUE(contains(error, "/extensionsRequired/1")) << error;
        EXPECT_TRUE(contains(error, name)) << error;
    }
}

TEST(Document, OptionalExtensionsAreIgnored)
{
    GltfBuilder builder = one_triangle();
    builder.json["extensionsUsed"] = {"VENDOR_magic", "KHR_materials_unlit"};
    EXPECT_EQ(error_of(builder), "");
}

TEST(Document, OtherVersionsAreRefused)
{
    GltfBuilder builder = one_triangle();
    builder.json["asset"]["version"] = "1.0";
    EXPECT_TRUE(contains(error_of(builder), "/asset/version"));
    builder.json["asset"] = {{"version", "2.1"}, {"minVersion", "2.1"}};
    EXPECT_TRUE(contains(error_of(builder), "/asset/minVersion"));
    builder.json["asset"] = {{"version", "2.1"}};
    EXPECT_EQ(error_of(builder), "");
    builder.json.erase("asset");
    EXPECT_TRUE(contains(error_of(builder), "\"asset\" is missing"));
}

TEST(Document, BrokenJsonIsReportedByLineAndColumn)
{
    const TempFolder folder;
    const std::string path = folder.write("a.gltf", std::string("{\n  \"asset\": }"));
    EXPECT_TRUE(contains(error_of_file(path), "line 2, column 12")) << error_of_file(path);
    EXPECT_TRUE(
        contains(error_of_file(folder.write("b.gltf", std::string("[1e999]"))), "too large"));
    EXPECT_TRUE(contains(error_of_file(folder.write("c.gltf", std::string("[]"))), "JSON object"));
    EXPECT_NE(error_of_file(folder.write("d.gltf", std::string("{\"\xff\": 1}"))), "");
}

TEST(Document, DeeplyNestedJsonDoesNotOverflowTheStack)
{
    const TempFolder folder;
    const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
    EXPECT_NE(error_of_file(folder.write("a.gltf", "{\"asset\": " + deep + "}")), "");
}

TEST(Document, JsonThatIsNestedWithoutEndIsRefused)
{
    constexpr std::size_t kDepth = 100'000;
    GltfBuilder builder = one_triangle();
    builder.json["extras"] = "here";
    std::string text = builder.json.dump();
    const std::string mark = "\"here\"";
    text.replace(text.find(mark), mark.size(), std::string(kDepth, '[') + std::string(kDepth, ']'));
    const TempFolder folder;
    EXPECT_TRUE(contains(error_of_file(folder.write("deep.gltf", text)), "nested more than"));
}

TEST(Document, TexturesThatMaterialsNameMustBeThereThoughNobodyReadsThem)
{
    for (const char* name : {"normalTexture", "MOZ_lightmap"})
        for (const Json& index : {Json(1), Json("0"), Json(-1)}) {
            GltfBuilder builder = one_triangle();
            Json material = {{"extensions", {{"AN_extension", {{name, {{"index", index}}}}}}}};
            builder.push("materials", material);
            EXPECT_TRUE(contains(error_of(builder), std::string(name) + "/index"));
        }
}

/// Two quads of one primitive, as a bake puts them on two pages: first, third | second, fourth
/// triangle.
GltfBuilder two_parts()
{
    GltfBuilder builder;
    const int positions = builder.add_positions({{0.0f, 0.0f, 0.0f},
                                                 {1.0f, 0.0f, 0.0f},
                                                 {1.0f, 1.0f, 0.0f},
                                                 {0.0f, 1.0f, 0.0f},
                                                 {2.0f, 0.0f, 0.0f},
                                                 {3.0f, 0.0f, 0.0f},
                                                 {3.0f, 1.0f, 0.0f},
                                                 {2.0f, 1.0f, 0.0f}});
    const auto indices = [&](const std::vector<std::uint32_t>& of) {
        return builder.add_accessor(of, "SCALAR", 5125, of.size());
    };
    const Json attributes = {{"POSITION", positions}};
    Json first = {{"attributes", attributes}, {"indices", indices({0, 1, 2, 0, 2, 3})}};
    Json second = {{"attributes", attributes}, {"indices", indices({4, 5, 6, 4, 6, 7})}};
    mark_part(first, {0, 1});
    mark_order(first, {0, 1, 0, 1});
    mark_part(second, {0, 3});
    builder.show(first);
    builder.json["meshes"][0]["primitives"].push_back(second);
    return builder;
}

Json& order_of(GltfBuilder& builder)
{
    return builder.json["meshes"][0]["primitives"][0]["extras"]["lumel_part"]["runs"];
}

TEST(PageParts, AreOnePrimitiveInItsOrderWithAPageForEachVertex)
{
    const Scene scene = two_parts().read();
    ASSERT_EQ(scene.meshes.at(0).primitives.size(), 1u);
    const Primitive& whole = scene.meshes[0].primitives[0];
    EXPECT_EQ(whole.indices, (std::vector<std::uint32_t>{0, 1, 2, 4, 5, 6, 0, 2, 3, 4, 6, 7}));
    EXPECT_EQ(whole.lightmap_pages, (std::vector<std::uint16_t>{1, 1, 1, 1, 3, 3, 3, 3}));
}

TEST(PageParts, StaySeveralWhereTheyDoNotFit)
{
    for (const Json& runs :
         {Json({0, 1, 1, 2}), Json({0, 2, 1, 3}), Json({0, 2, 2, 2}), Json({0, -2, 1, 2}),
          Json({0}), Json("all"), Json(), Json({0, 4294967296, 1, 2})}) {
        GltfBuilder builder = two_parts();
        order_of(builder) = runs;
        EXPECT_EQ(builder.read().meshes.at(0).primitives.size(), 2u) << runs;
    }
    GltfBuilder apart = two_parts();  // of vertices of their own
    std::vector<glm::vec3> others;
    for (int i = 0; i < 8; ++i)
        others.emplace_back(float(i % 4 == 1 || i % 4 == 2), float(i % 4 / 2), float(i / 4));
    apart.json["meshes"][0]["primitives"][1]["attributes"]["POSITION"] =
        apart.add_positions(others);
    EXPECT_EQ(apart.read().meshes.at(0).primitives.size(), 2u);
}

TEST(PageParts, ThatAFileHasJoinedItselfMustFit)
{
    const auto error_with = [](const Json& part) {
        GltfBuilder builder = two_parts();
        builder.json["meshes"][0]["primitives"].erase(1);
        builder.json["meshes"][0]["primitives"][0]["extras"]["lumel_part"] = part;
        return error_of(builder);
    };
    const Json indices = {1, 2}, pages = {0, 1};
    EXPECT_TRUE(contains(error_with({{"indices", indices}, {"pages", pages}}), "lumel_part"));
    EXPECT_TRUE(contains(error_with({{"indices", indices}, {"pages", {0}}, {"runs", {0, 2}}}),
                         "lumel_part"));
    EXPECT_TRUE(contains(error_with({{"indices", {1, 99}}, {"pages", pages}, {"runs", {0, 2}}}),
                         "accessors"));
    EXPECT_TRUE(contains(
        error_with({{"indices", indices}, {"pages", pages}, {"runs", {0, 2000000000, 0, 1, 1, 1}}}),
        "do not fit each other"));
}

TEST(SplitSides, MaterialsOfVariantsBecomeDoubleSidedAgainToo)
{
    Json gltf = Json::parse(R"({"materials": [{}, {}, {}, {}], "meshes": [{"primitives": [
        {"material": 0, "extensions": {"KHR_materials_variants": {"mappings": [
            {"material": 1, "variants": [0]}, {"material": 2, "variants": [1]}]}}},
        {"material": 0}]}]})");
    mark_side(gltf["meshes"][0]["primitives"][0], MarkedSide::front);
    mark_side(gltf["meshes"][0]["primitives"][1], MarkedSide::back);
    join_sides(gltf);
    EXPECT_EQ(gltf["meshes"][0]["primitives"].size(), 1u);
    for (std::size_t material = 0; material < 3; ++material)
        EXPECT_TRUE(gltf["materials"][material].value("doubleSided", false)) << material;
    EXPECT_FALSE(gltf["materials"][3].contains("doubleSided"));
}
