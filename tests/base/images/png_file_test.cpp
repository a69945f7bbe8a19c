#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <png.h>

#include "../../support/temporary_folder.h"
#include "base/core/error.h"
#include "base/images/image_files.h"

namespace lumel {
namespace {

// libpng's own reader, so that writer and reader share no code of ours.
std::vector<unsigned char> decode(const std::vector<unsigned char>& bytes, int& width, int& height)
{
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
    image.format = PNG_FORMAT_RGBA;
    std::vector<unsigned char> rgba(PNG_IMAGE_SIZE(image));
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, rgba.data(), 0, nullptr));
    width = int(image.width);
    height = int(image.height);
    return rgba;
}

TEST(PngFile, ValuesComeBackAsTheNearestOf256)
{
    Image image(16, 16, 4);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = float(i % 256) / 255.0f + (i % 2 ? 0.001f : -0.001f);
    int width = 0, height = 0;
    const std::vector<unsigned char> rgba = decode(encode_png(image), width, height);
    ASSERT_EQ(width, 16);
    ASSERT_EQ(height, 16);
    for (std::size_t i = 0; i < rgba.size(); ++i)
        EXPECT_EQ(rgba[i], i % 256);
}

TEST(PngFile, ValuesOutsideTheRangeAreClamped)
{
    Image image(1, 1, 3);
    image.values = {-1.0f, 7.0f, NAN};
    int width = 0, height = 0;
    const std::vector<unsigned char> rgba = decode(encode_png(image), width, height);
    EXPECT_EQ(rgba, (std::vector<unsigned char>{0, 255, 0, 255}));
}

TEST(PngFile, OnDiskAndInMemoryAreTheSameBytes)
{
    const test::TemporaryFolder folder;
    Image image(33, 9, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = float(i) / float(image.values.size());
    write_png(folder / "a.png", image);
    const std::vector<char> file = test::bytes_of(folder / "a.png");
    const std::vector<unsigned char> memory = encode_png(image);
    ASSERT_EQ(file.size(), memory.size());
    EXPECT_EQ(std::memcmp(file.data(), memory.data(), file.size()), 0);
}

TEST(PngFile, AnImageWithoutTexelsIsAnOutputError)
{
    EXPECT_THROW(encode_png(Image(0, 0, 4)), Error);
}

}  // namespace
}  // namespace lumel
