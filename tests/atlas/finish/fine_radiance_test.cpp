#include <numbers>

#include <gtest/gtest.h>

#include "atlas/finish/fine_radiance.h"
#include "grid_lumels.h"

namespace lumel {
namespace {

using test::rgb;

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kSide = 4;   // of the texture and of the square that it covers [texels of each]
constexpr int kScale = 8;  // so that a texel of the texture is 8 fine ones wide

// White where this is true.
bool is_white(int x, int y)
{
    return (x + y) % 2 == 0;
}

// A square under a chequered texture, and a sliver at its right.
Scene scene()
{
    Scene scene;
    Texture texture{.width = kSide, .height = kSide, .rgba = {}};
    for (int i = 0; i < kSide * kSide; ++i)
        texture.rgba.insert(texture.rgba.end(), 4, is_white(i % kSide, i / kSide) ? 255 : 0);
    scene.textures.push_back(texture);
    Material material;
    material.base_color_texture.texture = 0;
    scene.materials.push_back(material);
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    primitive.texcoords[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back({"square", {primitive}});
    scene.instances.push_back({"square", 0, 0, glm::mat4(1.0f)});
    return scene;
}

Atlas atlas()
{
    Surface square{.source_vertex = {0, 1, 2, 3},
                   .texcoord = {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}},
                   .indices = {0, 1, 2, 0, 2, 3},
                   .chart = {0, 0}};
    Surface sliver{.source_vertex = {0, 1, 2},
                   .texcoord = {{5.001f, 0.001f}, {5.011f, 0.001f}, {5.011f, 0.011f}},
                   .indices = {0, 1, 2},
                   .chart = {1}};
    Atlas atlas;
    atlas.width = 2 * kSide;
    atlas.height = kSide;
    atlas.chart_count = 2;
    atlas.surfaces = {square, sliver};
    return atlas;
}

// Light that grows by π lx from one texel to the next.
Image light()
{
    Image map(2 * kSide, kSide, 4);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            for (int c = 0; c < 3; ++c)
                map.at(x, y)[c] = kPi * float(x + 1);
    return map;
}

Image coarse()
{
    Image map(2 * kSide, kSide, 4);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            std::fill_n(map.at(x, y), 4, x < kSide || (x == 5 && y == 0) ? 1.0f : 0.0f);
    map.at(5, 0)[0] = 7.0f;
    return map;
}

TEST(FineRadiance, ShowsColourAtTheTexturesDensityUnderLightThatVariesSmoothly)
{
    const Image fine = fine_radiance(scene(), atlas(), light(), coarse(), kScale);
    ASSERT_EQ(fine.width, 2 * kSide * kScale);
    // Around the middle of each texel of the texture, where its neighbours do not count.
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            for (const int step : {-1, 0}) {
                const int column = x * kScale + kScale / 2 + step;
                const glm::vec3 found = rgb(fine, column, y * kScale + kScale / 2);
                const float arriving = (float(column) + 0.5f) / kScale + 0.5f;
                EXPECT_NEAR(found.r / arriving, is_white(x, y) ? 1.0f : 0.0f, 0.15f);
            }
}

TEST(FineRadiance, ShowsItOnBacksWithTexelsOfTheirOwnToo)
{
    Atlas two_sides = atlas();
    two_sides.surfaces.pop_back();
    two_sides.chart_count = 1;
    two_sides.back_shift = {{kSide, 0}};
    const Image fine = fine_radiance(scene(), two_sides, light(), coarse(), kScale);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const int column = (kSide + x) * kScale + kScale / 2;
            const glm::vec3 found = rgb(fine, column, y * kScale + kScale / 2);
            const float arriving = (float(column) + 0.5f) / kScale + 0.5f;
            EXPECT_NEAR(found.r / arriving, is_white(x, y) ? 1.0f : 0.0f, 0.15f);
        }
}

TEST(FineRadiance, WhatIsThinnerThanATexelShowsTheCoarseMap)
{
    const Image fine = fine_radiance(scene(), atlas(), light(), coarse(), kScale);
    EXPECT_EQ(rgb(fine, 5 * kScale + 3, 3), glm::vec3(7.0f, 1.0f, 1.0f));
}

TEST(FineRadiance, TheDensityIsTexelsOfTheTextureForEachOfTheAtlas)
{
    Scene dense = scene();
    EXPECT_EQ(texture_density(dense, atlas()), 1);
    dense.textures[0].width = 3 * kSide;
    dense.textures[0].height = 3 * kSide;
    dense.textures[0].rgba.resize(std::size_t(9 * kSide * kSide * 4));
    EXPECT_EQ(texture_density(dense, atlas()), 3);
    dense.materials[0].base_color_texture.texture = -1;
    EXPECT_EQ(texture_density(dense, atlas()), 1);
}

}  // namespace
}  // namespace lumel
