#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "../../support/input_error.h"
#include "../../support/temporary_folder.h"
#include "base/core/error.h"
#include "base/images/image_files.h"

namespace lumel {
namespace {

Image gradient(int width, int height, int channels)
{
    Image image(width, height, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = std::exp(float(i % 97) * 0.19f - 8.0f);
    return image;
}

TEST(ExrFile, FloatsComeBackExactly)
{
    const test::TemporaryFolder folder;
    const Image image = gradient(37, 19, 4);
    write_exr(folder / "a.exr", image, Precision::float32, {{"units", "lx"}});
    const Image read = read_exr(folder / "a.exr");
    ASSERT_EQ(read.width, 37);
    ASSERT_EQ(read.height, 19);
    EXPECT_EQ(read.values, image.values);
}

TEST(ExrFile, HalvesComeBackWithinTheirPrecisionAndBounded)
{
    const test::TemporaryFolder folder;
    Image image = gradient(16, 16, 4);
    image.values[0] = 1e9f;
    write_exr(folder / "a.exr", image, Precision::float16, {});
    const Image read = read_exr(folder / "a.exr");
    EXPECT_EQ(read.values[0], 65504.0f);
    for (std::size_t i = 1; i < image.values.size(); ++i)
        EXPECT_NEAR(read.values[i], image.values[i], image.values[i] / 2048.0f + 3e-8f);
}

TEST(ExrFile, AnImageWithoutAlphaReadsAsFullyCovered)
{
    const test::TemporaryFolder folder;
    const Image image = gradient(5, 4, 3);
    write_exr(folder / "a.exr", image, Precision::float32, {});
    const Image read = read_exr(folder / "a.exr");
    EXPECT_EQ(read.channels, 4);
    EXPECT_EQ(read.at(3, 2)[1], image.at(3, 2)[1]);
    EXPECT_EQ(read.at(3, 2)[3], 1.0f);
}

TEST(ExrFile, TheSameImageGivesTheSameBytes)
{
    const test::TemporaryFolder folder;
    const Image image = gradient(64, 64, 4);
    write_exr(folder / "a.exr", image, Precision::float32, {{"units", "lx"}, {"encoding", "H"}});
    write_exr(folder / "b.exr", image, Precision::float32, {{"units", "lx"}, {"encoding", "H"}});
    EXPECT_EQ(test::bytes_of(folder / "a.exr"), test::bytes_of(folder / "b.exr"));
}

TEST(ExrFile, LayersComeBackByNameBesideTheMainImage)
{
    const test::TemporaryFolder folder;
    const Image image = gradient(23, 11, 4);
    std::vector<Layer> layers = {{"sh.0", gradient(23, 11, 3)}, {"sh.1", gradient(23, 11, 4)}};
    for (float& value : layers[1].image.values)
        value = -value;
    write_exr(folder / "a.exr", image, Precision::float32, {}, layers);
    EXPECT_EQ(read_exr(folder / "a.exr").values, image.values);
    for (const Layer& layer : layers) {
        const Image read = read_exr(folder / "a.exr", layer.name);
        for (int y = 0; y < 11; ++y)
            for (int x = 0; x < 23; ++x) {
                for (int c = 0; c < 3; ++c)
                    ASSERT_EQ(read.at(x, y)[c], layer.image.at(x, y)[c]);
                ASSERT_EQ(read.at(x, y)[3], 1.0f);
            }
    }
}

TEST(ExrFile, LayersAreClampedToHalfAsTheMainImageIs)
{
    const test::TemporaryFolder folder;
    Image bright = gradient(4, 4, 3);
    bright.values[0] = -1e9f;
    write_exr(folder / "a.exr", gradient(4, 4, 4), Precision::float16, {},
              std::vector<Layer>{{"sh.0", bright}});
    EXPECT_EQ(read_exr(folder / "a.exr", "sh.0").values[0], -65504.0f);
}

TEST(ExrFile, ALayerThatIsNotThereIsAnInputErrorThatNamesIt)
{
    const test::TemporaryFolder folder;
    write_exr(folder / "a.exr", gradient(4, 4, 4), Precision::float32, {});
    try {
        read_exr(folder / "a.exr", "sh.7");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_NE(std::string(error.what()).find("sh.7"), std::string::npos);
    }
}

TEST(ExrFile, WhatIsNotAnExrIsAnInputErrorThatNamesTheFile)
{
    const test::TemporaryFolder folder;
    std::ofstream(folder / "text.exr") << "not an image";
    for (const char* name : {"text.exr", "missing.exr"}) {
        try {
            read_exr(folder / name);
            FAIL() << name << " was read";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
        }
    }
}

TEST(ExrFile, ATruncatedExrIsAnInputError)
{
    const test::TemporaryFolder folder;
    write_exr(folder / "a.exr", gradient(64, 64, 4), Precision::float32, {});
    std::filesystem::resize_file(folder / "a.exr", 900);
    EXPECT_THROW(read_exr(folder / "a.exr"), Error);
}

TEST(ExrFile, AHeaderThatClaimsFarMoreThanTheFileHoldsIsAnInputError)
{
    const test::TemporaryFolder folder;
    const std::string path = folder / "a.exr";
    write_exr(path, gradient(4, 4, 4), Precision::float32, {});
    std::ifstream in(path, std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(in), {});
    for (const char* window : {"dataWindow", "displayWindow"}) {
        // A name and the type "box2i", both ended by 0, a size of 4 bytes, two corners.
        const std::size_t corner = bytes.find(window) + std::strlen(window) + 1 + 6 + 4;
        for (const std::size_t k : {8u, 12u})
            bytes.replace(corner + k, 4, std::string("\xff\x3f\x00\x00", 4));
    }
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_THROW(read_exr(path), Error);
}

/// What is said of an EXR after `from` in its header was replaced by `to`.
std::string error_with(const std::string& from, const std::string& to)
{
    const test::TemporaryFolder folder;
    write_exr(folder / "a.exr", gradient(4, 4, 3), Precision::float16, {{"note", "word"}});
    std::vector<char> bytes = test::bytes_of(folder / "a.exr");
    const auto place = std::search(bytes.begin(), bytes.end(), from.begin(), from.end());
    EXPECT_NE(place, bytes.end());
    std::copy(to.begin(), to.end(), place);
    std::ofstream(folder / "a.exr", std::ios::binary)
        .write(bytes.data(), std::streamsize(bytes.size()));
    return test::input_error_of([&] { read_exr(folder / "a.exr"); });
}

std::string with_zeros(const char* text, std::size_t size)
{
    return {text, size};
}

// The library takes memory for these before it looks whether there is anything; it would have
// failed later and with other words.

TEST(ExrFile, AnAttributeLargerThanTheFileIsRefusedBeforeMemoryIsTakenForIt)
{
    EXPECT_NE(
        error_with(with_zeros("string\0\4\0\0\0word", 15), with_zeros("string\0\4\0\0\x60word", 15))
            .find("its header is cut short"),
        std::string::npos);
}

TEST(ExrFile, AnAttributeOfAnotherSizeThanItsTypeIsRefused)
{
    EXPECT_NE(error_with(with_zeros("float\0\4\0\0\0", 10), with_zeros("float\0\5\0\0\0", 10))
                  .find("wrong size"),
              std::string::npos);
}

TEST(ExrFile, MoreRowsThanTheFileHasPlacesOfIsRefusedBeforeMemoryIsTakenForThem)
{
    const std::string window("dataWindow\0box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0\3\0\0\0", 33);
    std::string tall = window + std::string("\xff\xff\xff\0", 4);
    EXPECT_NE(error_with(window, tall).find("claims to hold more texels"), std::string::npos);
}

TEST(ExrFile, APipeThatNobodyWritesToIsRefused)
{
    const test::TemporaryFolder folder;
    const std::string path = folder / "pipe.exr";
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    EXPECT_THROW(read_exr(path), Error);
}

TEST(ExrFile, APlaceThatCannotBeWrittenIsAnOutputError)
{
    try {
        write_exr("/nowhere/a.exr", gradient(4, 4, 4), Precision::float32, {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::output);
    }
}

}  // namespace
}  // namespace lumel
