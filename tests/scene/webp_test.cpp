// EXT_texture_webp against the same texels in PNG.

#include <gtest/gtest.h>
#include <webp/encode.h>

#include "../support/source_folder.h"
#include "compressed_file.h"

using namespace lumel;
using namespace lumel::test;

namespace {

constexpr int kWidth = 24, kHeight = 16;

/// Smooth colours, partly seen through.
Bytes texels()
{
    Bytes rgba;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (const int value : {x * 10, y * 15, 128 + x - y, 255 - 4 * y})
                rgba.push_back(std::uint8_t(value));
    return rgba;
}

/// A wave that shows a picture.
GltfBuilder textured(const Bytes& file, const char* type, const Json& texture)
{
    GltfBuilder builder = RayBatch().plain();
    const int view = builder.add_view(file.data(), file.size());
    builder.push("images", {{"bufferView", view}, {"mimeType", type}});
    builder.push("textures", texture);
    builder.push("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    return builder;
}

GltfBuilder with_webp(const Bytes& file)
{
    GltfBuilder builder =
        textured(file, "image/webp", {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
    builder.json["extensionsUsed"] = {"EXT_texture_webp"};
    builder.json["extensionsRequired"] = {"EXT_texture_webp"};
    return builder;
}

}  // namespace

TEST(Webp, LosslessPicturesAreThoseOfThePng)
{
    const Bytes png = make_png(kWidth, kHeight, texels());
    EXPECT_EQ(with_webp(make_webp(kWidth, kHeight, texels())).read().hash,
              textured(png, "image/png", {{"source", 0}}).read().hash);
}

TEST(Webp, LossyPicturesAreNearThem)
{
    std::uint8_t* file = nullptr;
    const Bytes rgba = texels();
    const std::size_t size = WebPEncodeRGBA(rgba.data(), kWidth, kHeight, kWidth * 4, 95.0f, &file);
    const Bytes bytes(file, file + size);
    WebPFree(file);
    const Scene scene = with_webp(bytes).read();
    ASSERT_EQ(scene.textures.size(), 1u);
    const Texture& texture = scene.textures[0];
    ASSERT_EQ(texture.rgba.size(), rgba.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < rgba.size(); ++i)
        sum += std::abs(double(texture.rgba[i]) - double(rgba[i]));
    EXPECT_LT(sum / double(rgba.size()), 4.0);
}

TEST(Webp, APlainSourceIsReadInstead)
{
    GltfBuilder builder = with_webp(make_webp(kWidth, kHeight, Bytes(texels().size(), 255)));
    const Bytes png = make_png(kWidth, kHeight, texels());
    const int view = builder.add_view(png.data(), png.size());
    builder.push("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    builder.json["textures"][0]["source"] = 1;
    EXPECT_EQ(builder.read().textures.at(0).rgba, texels());
}

TEST(Webp, TheDocumentIsThatOfAPlainFile)
{
    const TempFolder folder;
    const GltfDocument document =
        load_gltf_document(with_webp(make_webp(kWidth, kHeight, texels())).write(folder));
    EXPECT_EQ(document.json["textures"][0], Json({{"source", 0}}));
    for (const char* key : {"extensionsUsed", "extensionsRequired"})
        EXPECT_FALSE(document.json.contains(key));
}

TEST(Webp, WhatIsWrongIsSaidWithItsPlace)
{
    const Bytes whole = make_webp(kWidth, kHeight, texels());
    const auto expect = [](const std::string& error, const std::string& place,
                           const std::string& what) {
        EXPECT_TRUE(contains(error, place)) << error;
        EXPECT_TRUE(contains(error, what)) << error;
    };
    expect(error_of(with_webp(Bytes(whole.begin(), whole.begin() + 20))), "/images/0",
           "without a readable header");
    expect(error_of(with_webp(Bytes(whole.begin(), whole.end() - 20))), "/images/0", "cut short");
    GltfBuilder absent = with_webp(whole);
    absent.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 5;
    expect(error_of(absent), "/textures/0/extensions/EXT_texture_webp/source", "images[5]");
    // A lossless header of 16383 x 16383 pixels.
    Bytes huge = whole;
    const std::uint8_t header[] = {0x2F, 0xFE, 0xBF, 0xFF, 0x0F};
    std::copy(std::begin(header), std::end(header), huge.begin() + 20);
    expect(error_of(with_webp(huge)), "/images/0", "claims 16383 x 16383 pixels");
}

TEST(Webp, ARoomOfOtherToolsHasItsTexture)
{
    const std::string path = support::data_path("gltf_conformance/selfmade/texture_webp.glb");
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << "the test data is absent";
    EXPECT_EQ(read_gltf(path).textures.size(), 1u);
}
