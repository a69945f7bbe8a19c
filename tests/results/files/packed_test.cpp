// What is written of packed files: plain geometry, and pictures as they are.

#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "../../scene/compressed_file.h"
#include "../../scene/twins.h"
#include "base/images/image_files.h"
#include "hand_atlas.h"
#include "results/files/gltf_write.h"
#include "scene/gltf/accessor.h"
#include "scene/load/webp_image.h"

namespace lumel::test {
namespace {

constexpr int kSide = 4;

Bytes webp_picture()
{
    Bytes rgba;
    for (int i = 0; i < kSide * kSide; ++i)
        rgba.insert(rgba.end(), {std::uint8_t(i * 16), std::uint8_t(255 - i), 7, 255});
    return make_webp(kSide, kSide, rgba);
}

/// The wave in a Draco stream, shown three times, cut out by a WebP picture.
GltfBuilder packed_scene()
{
    GltfBuilder builder = draco_wave({});
    builder.json["nodes"][0]["name"] = "wave";
    const std::vector<glm::vec3> places = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}};
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", builder.add_accessor(places, "VEC3", 5126, places.size())}};
    const Bytes file = webp_picture();
    const int view = builder.add_view(file.data(), file.size());
    builder.push("images", {{"bufferView", view}, {"mimeType", "image/webp"}});
    builder.push("textures", {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
    builder.push("materials", {{"alphaMode", "MASK"},
                               {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        for (const char* name : {"EXT_mesh_gpu_instancing", "EXT_texture_webp"})
            builder.json[list].push_back(name);
    return builder;
}

TEST(Packed, GeometryIsWrittenPlainAndShowsTheSame)
{
    const TempFolder folder;
    const Scene scene = read_gltf(packed_scene().write(folder));
    ASSERT_EQ(scene.instances.size(), 3u);
    const Atlas atlas = corner_atlas(scene);
    const std::string written = folder.path("written.glb");
    write_scene_glb(written, load_gltf_document(scene.path), scene, atlas, any_map(atlas), {});

    const GltfDocument document = load_gltf_document(written);
    const std::string json = document.json.dump();
    for (const char* name : {"draco", "gpu_instancing"})
        EXPECT_EQ(json.find(name), std::string::npos) << name << ": " << json;
    // A node and a mesh for each instance, below the one that had them.
    EXPECT_EQ(document.json["nodes"][0]["children"], Json({1, 2, 3}));
    EXPECT_EQ(document.json["meshes"].size(), 3u);

    const Scene again = read_gltf(written);
    expect_twins(scene, again, {});
    ASSERT_EQ(again.textures.size(), 1u);
    EXPECT_EQ(again.textures[0].rgba, scene.textures[0].rgba);
}

/// JSON of a .glb, as it is in the file.
Json json_of_glb(const std::string& path)
{
    constexpr std::size_t kText = 20;  // behind the headers of the file and of its first chunk
    const Bytes file = read_file(path, path);
    std::uint32_t length = 0;
    std::memcpy(&length, file.data() + 12, sizeof length);
    return Json::parse(file.begin() + kText, file.begin() + kText + length);
}

TEST(Packed, PicturesStayAsTheyAre)
{
    const TempFolder folder;
    const Scene scene = read_gltf(packed_scene().write(folder));
    const Atlas atlas = corner_atlas(scene);
    const std::string written = folder.path("written.glb");
    write_scene_glb(written, load_gltf_document(scene.path), scene, atlas, any_map(atlas));
    const Json json = json_of_glb(written);
    for (const char* key : {"extensionsUsed", "extensionsRequired"})
        EXPECT_NE(std::ranges::find(json[key], "EXT_texture_webp"), json[key].end()) << json[key];
    EXPECT_FALSE(json["textures"][0].contains("source"));
    const std::size_t image = json["textures"][0]["extensions"]["EXT_texture_webp"]["source"];
    EXPECT_EQ(json["images"][image]["mimeType"], "image/webp");
    EXPECT_EQ(read_image_bytes(load_gltf_document(written), image), webp_picture());
    // The lightmap's texture needs no extension.
    EXPECT_TRUE(json["textures"][1].contains("source"));
}

TEST(Packed, PicturesOfSceneBakedArePlain)
{
    const TempFolder folder;
    const Scene scene = read_gltf(packed_scene().write(folder));
    const Atlas atlas = corner_atlas(scene);
    const std::string written = folder.path("baked.glb");
    write_baked_glb(written, load_gltf_document(scene.path), scene, atlas, any_map(atlas));
    const GltfDocument document = load_gltf_document(written);
    EXPECT_EQ(json_of_glb(written).dump().find("webp"), std::string::npos);
    ASSERT_EQ(document.json["images"].size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_FALSE(is_webp(read_image_bytes(document, i)));
    EXPECT_EQ(read_gltf(written).textures[0].rgba, scene.textures[0].rgba);
}

/// A texture that has a PNG as well keeps both.
TEST(Packed, PicturesWithAFallbackKeepBoth)
{
    const TempFolder folder;
    GltfBuilder builder = packed_scene();
    const Bytes rgba(std::size_t(kSide) * kSide * 4, 200);
    const std::vector<unsigned char> png = encode_png(rgba, kSide, kSide);
    const int view = builder.add_view(png.data(), png.size());
    builder.push("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    builder.json["textures"][0]["source"] = 1;
    builder.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Scene scene = read_gltf(builder.write(folder));
    const Atlas atlas = corner_atlas(scene);
    const std::string written = folder.path("written.glb");
    write_scene_glb(written, load_gltf_document(scene.path), scene, atlas, any_map(atlas));
    const Json json = json_of_glb(written);
    EXPECT_EQ(json["textures"][0]["source"], 1);
    EXPECT_EQ(json["textures"][0]["extensions"]["EXT_texture_webp"]["source"], 0);
    EXPECT_NE(std::ranges::find(json["extensionsUsed"], "EXT_texture_webp"),
              json["extensionsUsed"].end());
    EXPECT_FALSE(json.contains("extensionsRequired")) << json["extensionsRequired"];
}

TEST(Packed, NothingOfTheStreamsIsLeftInTheFile)
{
    const TempFolder folder;
    const Scene scene = read_gltf(packed_scene().write(folder));
    const Atlas atlas = corner_atlas(scene);
    const std::string written = folder.path("written.glb");
    write_scene_glb(written, load_gltf_document(scene.path), scene, atlas, any_map(atlas), {});
    const Bytes file = read_file(written, written);
    const std::string mark = "DRACO\x02\x02";
    EXPECT_EQ(std::search(file.begin(), file.end(), mark.begin(), mark.end()), file.end());
}

}  // namespace
}  // namespace lumel::test
