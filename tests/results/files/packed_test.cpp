// What is written of packed files is plain.

#include <algorithm>

#include <gtest/gtest.h>

#include "../../scene/compressed_file.h"
#include "../../scene/twins.h"
#include "hand_atlas.h"
#include "results/files/gltf_write.h"
#include "scene/gltf/accessor.h"
#include "scene/load/webp_image.h"

namespace lumel::test {
namespace {

constexpr int kSide = 4;

/// The wave in a Draco stream, shown three times, with a WebP picture.
GltfBuilder packed_scene()
{
    GltfBuilder builder = draco_wave({});
    builder.json["nodes"][0]["name"] = "wave";
    const std::vector<glm::vec3> places = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}};
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", builder.add_accessor(places, "VEC3", 5126, places.size())}};
    Bytes rgba;
    for (int i = 0; i < kSide * kSide; ++i)
        rgba.insert(rgba.end(), {std::uint8_t(i * 16), std::uint8_t(255 - i), 7, 255});
    const Bytes file = make_webp(kSide, kSide, rgba);
    const int view = builder.add_view(file.data(), file.size());
    builder.push("images", {{"bufferView", view}, {"mimeType", "image/webp"}});
    builder.push("textures", {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
    builder.push("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        for (const char* name : {"EXT_mesh_gpu_instancing", "EXT_texture_webp"})
            builder.json[list].push_back(name);
    return builder;
}

TEST(Packed, WhatIsWrittenIsPlainAndShowsTheSame)
{
    const TempFolder folder;
    const Scene scene = read_gltf(packed_scene().write(folder));
    ASSERT_EQ(scene.instances.size(), 3u);
    const Atlas atlas = corner_atlas(scene);
    const std::string written = folder.path("written.glb");
    write_scene_glb(written, load_gltf_document(scene.path), scene, atlas, any_map(atlas), {});

    const GltfDocument document = load_gltf_document(written);
    const std::string json = document.json.dump();
    for (const char* name : {"draco", "gpu_instancing", "webp"})
        EXPECT_EQ(json.find(name), std::string::npos) << name << ": " << json;
    for (std::size_t i = 0; i < document.json["images"].size(); ++i)
        EXPECT_FALSE(is_webp(read_image_bytes(document, i)));
    // A node and a mesh for each instance, below the one that had them.
    EXPECT_EQ(document.json["nodes"][0]["children"], Json({1, 2, 3}));
    EXPECT_EQ(document.json["meshes"].size(), 3u);

    const Scene again = read_gltf(written);
    expect_twins(scene, again, {});
    ASSERT_EQ(again.textures.size(), 1u);
    EXPECT_EQ(again.textures[0].rgba, scene.textures[0].rgba);
}

TEST(Packed, NothingOfTheStreamsIsLeftInTheFile)
{
    const TempFolder folder;
    const Scene scene = read_gltf(packed_scene().write(folder));
    const Atlas atlas = corner_atlas(scene);
    const std::string written = folder.path("written.glb");
    write_scene_glb(written, load_gltf_document(scene.path), scene, atlas, any_map(atlas), {});
    const Bytes file = read_file(written, written);
    for (const std::string& mark : {std::string("DRACO\x02\x02"), std::string("WEBPVP8")})
        EXPECT_EQ(std::search(file.begin(), file.end(), mark.begin(), mark.end()), file.end())
            << mark;
}

}  // namespace
}  // namespace lumel::test
