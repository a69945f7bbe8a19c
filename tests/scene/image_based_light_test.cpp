// EXT_lights_image_based: the directions of its faces, and their brightness.

#include <gtest/gtest.h>

#include "gltf_builder.h"

using namespace lumel;
using namespace lumel::test;

namespace {

/// Bytes of a texel; 255 is 1 in linear light.
struct Rgba {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
};

Bytes face_of(const std::vector<Rgba>& texels)
{
    Bytes bytes;
    for (const Rgba& texel : texels)
        bytes.insert(bytes.end(), {texel.r, texel.g, texel.b, texel.a});
    return bytes;
}

/// A scene with an image-based light of square faces.
GltfBuilder with_faces(const std::vector<std::vector<Rgba>>& faces, int size)
{
    GltfBuilder builder = one_triangle();
    Json list = Json::array();
    for (const std::vector<Rgba>& texels : faces) {
        const Bytes png = make_png(size, size, face_of(texels));
        const int view = builder.add_view(png.data(), png.size());
        list.push_back(builder.push("images", {{"bufferView", view}, {"mimeType", "image/png"}}));
    }
    Json light;
    light["specularImageSize"] = size;
    light["specularImages"] = Json::array({list});
    builder.json["extensionsRequired"] = {"EXT_lights_image_based"};
    builder.json["extensions"]["EXT_lights_image_based"]["lights"] = Json::array({light});
    builder.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    return builder;
}

Json& light_of(GltfBuilder& builder)
{
    return builder.json["extensions"]["EXT_lights_image_based"]["lights"][0];
}

/// Faces of one texel each in six colours.
GltfBuilder six_colors()
{
    return with_faces({{{255, 0, 0}},
                       {{0, 255, 0}},
                       {{0, 0, 255}},
                       {{255, 255, 0}},
                       {{0, 255, 255}},
                       {{255, 0, 255}}},
                      1);
}

}  // namespace

TEST(ImageBasedLight, FacesLookAlongTheirAxes)
{
    const Sky sky = six_colors().read().sky;
    const float e = 0.2f;  // away from the corners of the coarse sky's texels
    const auto towards = [&](const glm::vec3& d) { return sky_radiance(sky, glm::normalize(d)); };
    EXPECT_EQ(sky.width, 4);
    EXPECT_GT(towards({0, 1, 0}).b, 0.4f);
    EXPECT_GT(towards({0, -1, 0}).r, 0.4f);
    EXPECT_GT(towards({1, e, -e}).r, 0.1f);
    EXPECT_EQ(towards({1, e, -e}).g, 0.0f);
}

TEST(ImageBasedLight, ImagesLookAsTheyDoFromInsideTheCube)
{
    // Each face is 8 × 8 and black, but for one quarter: top left, as seen from inside.
    const auto top_left_of = [](int lit) {
        std::vector<std::vector<Rgba>> faces(6, std::vector<Rgba>(64));
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x)
                faces[std::size_t(lit)][std::size_t(8 * y + x)] = {255, 255, 255};
        return with_faces(faces, 8).read().sky;
    };
    // Who looks along +x has -z on the left, along -x +z; along +z has +x on the left, along -z -x.
    // Above, row 0 is towards -z and its left +x; below, row 0 is towards +z and its left +x.
    const glm::vec3 middles[] = {{1, 0.5f, -0.5f}, {-1, 0.5f, 0.5f}, {0.5f, 1, -0.5f},
                                 {0.5f, -1, 0.5f}, {0.5f, 0.5f, 1},  {-0.5f, 0.5f, -1}};
    for (int face = 0; face < 6; ++face) {
        const Sky sky = top_left_of(face);
        for (int other = 0; other < 6; ++other) {
            const glm::vec3 seen = sky_radiance(sky, glm::normalize(middles[other]));
            EXPECT_FLOAT_EQ(seen.g, face == other ? 1.0f : 0.0f) << face << " and " << other;
        }
    }
}

TEST(ImageBasedLight, AlphaDividesAndIntensityMultiplies)
{
    const std::vector<Rgba> bright = {{255, 188, 0, 51}};  // 5, and 5 × 0.5029 of the sRGB curve
    GltfBuilder builder = with_faces(std::vector<std::vector<Rgba>>(6, bright), 1);
    light_of(builder)["intensity"] = 3;
    const Sky sky = builder.read().sky;
    for (const glm::vec3& radiance : sky.radiance) {
        EXPECT_NEAR(radiance.r, 15.0f, 1e-4f);
        EXPECT_NEAR(radiance.g, 15.0f * 0.5029f, 1e-2f);
        EXPECT_EQ(radiance.b, 0.0f);
    }
}

TEST(ImageBasedLight, TheRotationTurnsTheCube)
{
    std::vector<std::vector<Rgba>> faces(6, std::vector<Rgba>(64));
    faces[0].assign(64, {255, 255, 255});
    GltfBuilder builder = with_faces(faces, 8);
    light_of(builder)["rotation"] = {0, 0.70710678, 0, 0.70710678};  // +x to -z
    const Sky sky = builder.read().sky;
    EXPECT_FLOAT_EQ(sky_radiance(sky, glm::normalize(glm::vec3(0.2f, 0.2f, -1))).r, 1.0f);
    EXPECT_FLOAT_EQ(sky_radiance(sky, glm::normalize(glm::vec3(1, 0.2f, 0.2f))).r, 0.0f);
}

TEST(ImageBasedLight, OnlyTheDefaultScenesLightCounts)
{
    GltfBuilder builder = six_colors();
    builder.json["scenes"][0].erase("extensions");
    EXPECT_TRUE(builder.read().sky.empty());
}

TEST(ImageBasedLight, BrokenOnesAreErrors)
{
    GltfBuilder builder = six_colors();
    Json& light = light_of(builder);
    light["intensity"] = -1;
    EXPECT_TRUE(contains(error_of(builder), "negative intensity"));
    light["intensity"] = 1;
    light["rotation"] = {0, 0, 0, 2};
    EXPECT_TRUE(contains(error_of(builder), "unit quaternion"));
    light.erase("rotation");
    light["specularImages"][0].erase(5);
    EXPECT_TRUE(contains(error_of(builder), "6 faces"));
    light["specularImages"][0].push_back(17);
    EXPECT_TRUE(contains(error_of(builder), "images[17]"));
    light.erase("specularImages");
    EXPECT_NE(error_of(builder), "");
    builder.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 1;
    EXPECT_TRUE(contains(error_of(builder), "lights[1]"));
}
