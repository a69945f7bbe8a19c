// Images that fail or lie.

#include <algorithm>

#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "scene/load/gltf_image.h"

using namespace lumel;
using namespace lumel::test;

namespace {

std::string error_with_image(const Bytes& image)
{
    GltfBuilder builder = one_triangle();
    builder.push("materials", {{"emissiveTexture", {{"index", 0}}}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    const int view = builder.add_view(image.data(), image.size());
    builder.push("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    builder.push("textures", {{"source", 0}});
    return error_of(builder);
}

Bytes small_png()
{
    return make_png(2, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16});
}

/// The PNG with another width and height in its header.
Bytes claiming(std::uint32_t width, std::uint32_t height)
{
    Bytes png = small_png();
    for (std::size_t i = 0; i < 4; ++i) {
        png[16 + i] = std::uint8_t(width >> (24 - 8 * i));
        png[20 + i] = std::uint8_t(height >> (24 - 8 * i));
    }
    return png;
}

/// A grey JPEG of 8 x 8 pixels, 8-bit baseline, one Huffman code per table.
Bytes small_jpeg()
{
    const Bytes head = {0xFF, 0xD8, 0xFF, 0xDB, 0x00, 0x43, 0x00};
    Bytes jpeg(head.size() + 64, 1);
    std::copy(head.begin(), head.end(), jpeg.begin());
    const Bytes rest = {0xFF, 0xC0, 0x00, 0x0B, 0x08, 0x00, 0x08, 0x00, 0x08, 0x01, 0x01, 0x11,
                        0x00, 0xFF, 0xC4, 0x00, 0x14, 0x00, 1,    0,    0,    0,    0,    0,
                        0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0x00, 0xFF,
                        0xC4, 0x00, 0x14, 0x10, 1,    0,    0,    0,    0,    0,    0,    0,
                        0,    0,    0,    0,    0,    0,    0,    0,    0x00, 0xFF, 0xDA, 0x00,
                        0x08, 0x01, 0x01, 0x00, 0x00, 0x3F, 0x00, 0x3F, 0xFF, 0xD9};
    jpeg.insert(jpeg.end(), rest.begin(), rest.end());
    return jpeg;
}

}  // namespace

TEST(Images, PngIsDecodedTopRowFirst)
{
    const Texture texture = decode_image(small_png(), "here");
    EXPECT_EQ(texture.width, 2);
    EXPECT_EQ(texture.height, 2);
    EXPECT_EQ(texture.rgba, (Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}));
}

TEST(Images, JpegIsDecodedAsOpaque)
{
    const Texture texture = decode_image(small_jpeg(), "here");
    ASSERT_EQ(texture.rgba.size(), 8u * 8u * 4u);
    EXPECT_EQ(texture.rgba[0], 128);
    EXPECT_EQ(texture.rgba[3], 255);
}

TEST(Images, AChunkLongerThanTheFileIsRefusedBeforeMemoryIsTakenForIt)
{
    Bytes png = small_png();
    constexpr std::size_t kFirstChunk = 8, kHeaderChunk = 25;
    png[kFirstChunk + kHeaderChunk] = 0x3F;  // of IDAT: 1 GiB
    EXPECT_TRUE(contains(error_with_image(png), "is a PNG image that is cut short"));
}

TEST(Images, AChunkOfAnyNameGivesOneLine)
{
    Bytes png = small_png();
    constexpr std::size_t kNameOfSecondChunk = 8 + 25 + 4;
    for (std::size_t i = 0; i < 4; ++i)
        png[kNameOfSecondChunk + i] = '\n';
    const std::string error = error_with_image(png);
    EXPECT_NE(error, "");
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

TEST(Images, HugeClaimsAreRefusedBeforeDecoding)
{
    EXPECT_TRUE(contains(error_with_image(claiming(65536, 32768)), "65536 x 32768 pixels"));
    EXPECT_TRUE(contains(error_with_image(claiming(0xFFFFFFFF, 0xFFFFFFFF)), "/images/0: claims"));
    EXPECT_TRUE(contains(error_with_image(claiming(16384, 16384)), "bytes can hold"));
    EXPECT_TRUE(contains(error_with_image(claiming(0, 2)), "claims 0 x 2"));
    Bytes jpeg = small_jpeg();
    const std::size_t height = 2 + 2 + 67 + 2 + 3;  // after the quantization table and SOF marker
    ASSERT_EQ(jpeg[height + 1], 8);
    jpeg[height] = jpeg[height + 2] = 0x3F;
    EXPECT_TRUE(contains(error_with_image(jpeg), "bytes can hold"));
}

TEST(Images, ADeflateBlockOfNoKnownTypeIsAnError)
{
    Bytes png = small_png();
    const Bytes mark = {'I', 'D', 'A', 'T'};
    const auto data = std::search(png.begin(), png.end(), mark.begin(), mark.end());
    ASSERT_NE(data, png.end());
    constexpr std::ptrdiff_t kZlibHeader = 2;
    data[std::ptrdiff_t(mark.size()) + kZlibHeader] = 0x07;  // the last block, of the reserved type
    EXPECT_TRUE(contains(error_with_image(png), "cannot be decoded"));
}

TEST(Images, TruncatedFilesAreErrors)
{
    const Bytes png = small_png();
    for (std::size_t size = 1; size < png.size() - 4; ++size)
        EXPECT_NE(error_with_image(Bytes(png.begin(), png.begin() + std::ptrdiff_t(size))), "")
            << size;
    const Bytes jpeg = small_jpeg();
    for (std::size_t size = 1; size < jpeg.size(); ++size)
        EXPECT_NE(error_with_image(Bytes(jpeg.begin(), jpeg.begin() + std::ptrdiff_t(size))), "")
            << size;
}

TEST(Images, OtherFormatsAreErrors)
{
    EXPECT_TRUE(
        contains(error_with_image({'G', 'I', 'F', '8', '9', 'a'}), "neither a PNG nor a JPEG"));
}

TEST(Images, AnImageNeedsExactlyOneSource)
{
    GltfBuilder builder = one_triangle();
    builder.push("materials", {{"emissiveTexture", {{"index", 0}}}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    builder.push("images", Json::object());
    builder.push("textures", {{"source", 0}});
    EXPECT_TRUE(contains(error_of(builder), "/images/0: must have either"));
}

TEST(Images, TheFirstBrokenImageIsReportedWhateverThreadsDo)
{
    GltfBuilder builder = one_triangle();
    constexpr int kCount = 16;
    for (int i = 0; i < kCount; ++i) {
        builder.push("images", {{"uri", "missing" + std::to_string(i) + ".png"}});
        builder.push("textures", {{"source", i}});
        builder.push("materials", {{"emissiveTexture", {{"index", i}}}});
        builder.json["meshes"][0]["primitives"][std::size_t(i)] = {
            {"attributes", {{"POSITION", 0}}}, {"material", i}};
    }
    for (int run = 0; run < 5; ++run)
        EXPECT_TRUE(contains(error_of(builder), "missing0.png"));
}
