// Skies from files.

#include <cmath>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "../support/input_error.h"
#include "../support/source_folder.h"
#include "base/images/image_files.h"
#include "gltf_builder.h"
#include "scene/sky/sky_file.h"

using namespace lumel;
using namespace lumel::test;

namespace {

/// A Radiance picture of texels without run-length coding: mantissas and the exponent's byte.
std::string radiance_picture(const std::string& size, const Bytes& texels)
{
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n" +
           std::string(texels.begin(), texels.end());
}

std::string error_of_sky(const std::string& path)
{
    return input_error_of([&] { read_sky(path); });
}

}  // namespace

TEST(SkyFile, ExrIsReadAsItIs)
{
    const TempFolder folder;
    Image image(3, 2, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = float(i) + 0.5f;
    write_exr(folder.path("sky.exr"), image, Precision::float32, {});
    const Sky sky = read_sky(folder.path("sky.exr"));
    ASSERT_EQ(sky.width, 3);
    ASSERT_EQ(sky.height, 2);
    EXPECT_EQ(sky.radiance[0], glm::vec3(0.5f, 1.5f, 2.5f));
    EXPECT_EQ(sky.radiance[5], glm::vec3(15.5f, 16.5f, 17.5f));
}

TEST(SkyFile, RadiancePicturesAreRead)
{
    const TempFolder folder;
    // Value = mantissa · 2^(exponent − 136).
    const std::string path = folder.write(
        "sky.HDR", radiance_picture("-Y 1 +X 2", {128, 64, 0, 129, 200, 100, 50, 146}));
    const Sky sky = read_sky(path);
    ASSERT_EQ(sky.width, 2);
    ASSERT_EQ(sky.height, 1);
    EXPECT_EQ(sky.radiance[0], glm::vec3(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(sky.radiance[1], glm::vec3(204800.0f, 102400.0f, 51200.0f));
}

TEST(SkyFile, RunLengthCodedPicturesAreRead)
{
    // Red: a run of 8; green: 8 values; blue: 3 + 5; exponents: a run of 8.
    const Bytes packed{2,  2,   0,   8, 136, 128, 8, 16,  32,  48,  64, 80,
                       96, 112, 128, 3, 1,   2,   3, 133, 200, 136, 129};
    const TempFolder folder;
    const Sky sky = read_sky(folder.write("sky.hdr", radiance_picture("-Y 1 +X 8", packed)));
    ASSERT_EQ(sky.width, 8);
    EXPECT_EQ(sky.radiance[0], glm::vec3(1.0f, 0.125f, 1.0f / 128.0f));
    EXPECT_EQ(sky.radiance[7], glm::vec3(1.0f, 1.0f, 200.0f / 128.0f));
    Bytes cut = packed;
    for (; cut.size() > 4; cut.pop_back())
        if (cut.size() < packed.size()) {
            EXPECT_NE(error_of_sky(folder.write("cut.hdr", radiance_picture("-Y 1 +X 8", cut))), "")
                << cut.size();
        }
}

TEST(SkyFile, WhatIsNoLightIsBlackAndInfinityIsBright)
{
    const TempFolder folder;
    Image image(2, 1, 3);
    image.values = {-1.0f, std::numeric_limits<float>::quiet_NaN(),
                    2.0f,  std::numeric_limits<float>::infinity(),
                    0.0f,  1.0f};
    write_exr(folder.path("sky.exr"), image, Precision::float32, {});
    const Sky sky = read_sky(folder.path("sky.exr"));
    EXPECT_EQ(sky.radiance[0], glm::vec3(0, 0, 2));
    EXPECT_EQ(sky.radiance[1], glm::vec3(65504, 0, 1));
}

TEST(SkyFile, BadFilesEndInOneSentence)
{
    const TempFolder folder;
    EXPECT_TRUE(contains(error_of_sky(folder.path("none.hdr")), "none.hdr: there is no such file"));
    EXPECT_TRUE(contains(error_of_sky(folder.path("none.exr")), "none.exr: there is no such file"));
    EXPECT_TRUE(contains(error_of_sky(folder.write("sky.png", Bytes{1})), "an .exr or .hdr file"));
    EXPECT_TRUE(contains(error_of_sky(folder.write("noise.hdr", std::string("noise"))),
                         "noise.hdr: is not a readable Radiance image"));
    EXPECT_TRUE(contains(error_of_sky(folder.write("noise.exr", std::string("noise"))),
                         "noise.exr: cannot be read as EXR"));
    EXPECT_TRUE(
        contains(error_of_sky(folder.write("short.hdr", radiance_picture("-Y 4 +X 4", Bytes(60)))),
                 "claims 4 x 4 pixels, more than its"));
    EXPECT_TRUE(contains(
        error_of_sky(folder.write("huge.hdr", radiance_picture("-Y 99999 +X 99999", Bytes(64)))),
        "at most 16384 a side"));
    EXPECT_NE(error_of_sky(folder.write("zero.hdr", radiance_picture("-Y 0 +X 0", {}))), "");
    Bytes packed{2, 2, 0, 8};
    packed.resize(4 + 8 * 4);  // runs of length 0
    EXPECT_TRUE(
        contains(error_of_sky(folder.write("runs.hdr", radiance_picture("-Y 1 +X 8", packed))),
                 "broken or cut short"));
}

TEST(SkyFile, TurningMovesTheCentreCounterClockwiseFromAbove)
{
    Sky sky{.width = 8, .height = 2};
    sky.radiance.assign(16, glm::vec3(0.0f));
    sky.radiance[4] = glm::vec3(8.0f);  // from +x towards +z by 0 to 45 degrees
    const double quarter = std::acos(0.0);
    const glm::vec3 before = glm::normalize(glm::vec3(1.0f, 0.2f, 0.3f));
    EXPECT_EQ(sky_radiance(sky, before).x, 8.0f);
    // A quarter counter-clockwise carries +x to -z, and +z to +x.
    const Sky quarter_on = turned(sky, quarter);
    EXPECT_NEAR(sky_radiance(quarter_on, {before.z, before.y, -before.x}).x, 8.0f, 1e-5f);
    EXPECT_NEAR(sky_radiance(quarter_on, before).x, 0.0f, 1e-5f);
    // Half a texel shares it between two.
    const Sky shared = turned(sky, quarter / 4.0);
    EXPECT_NEAR(shared.radiance[3].x, 4.0f, 1e-5f);
    EXPECT_NEAR(shared.radiance[4].x, 4.0f, 1e-5f);
    EXPECT_NEAR(turned(sky, -4.0 * quarter).radiance[4].x, 8.0f, 1e-4f);
}

TEST(SkyFile, RealSkiesHaveTheirIrradiance)
{
    const std::string folder = support::data_path("hdri/blender_world/");
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "the test data is absent";
    const std::pair<const char*, glm::dvec3> expected[] = {
        {"city", {6.9024, 7.0894, 7.2167}},    {"courtyard", {1.8826, 2.0991, 3.1227}},
        {"forest", {3.0329, 3.3332, 3.9656}},  {"interior", {7.4401, 6.2821, 4.6976}},
        {"night", {0.5787, 0.5147, 0.4644}},   {"studio", {0.6040, 0.6631, 0.6745}},
        {"sunrise", {1.5013, 1.7942, 2.0677}}, {"sunset", {1.7913, 2.2017, 3.4050}},
    };
    for (const auto& [name, irradiance] : expected) {
        const glm::dvec3 found = sky_irradiance(read_sky(folder + name + ".exr"));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], irradiance[c], 0.01 * irradiance[c]) << name;
    }
}
