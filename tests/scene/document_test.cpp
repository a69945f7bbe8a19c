// The low level: containers, JSON, buffers and accessors.

#include <gtest/gtest.h>

#include "gltf/split_sides.h"
#include "gltf_builder.h"

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
