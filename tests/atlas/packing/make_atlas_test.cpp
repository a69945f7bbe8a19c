#include <cstring>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "atlas/charts/overlap.h"
#include "base/core/error.h"
#include "shapes.h"

namespace lumel::test {
namespace {

Scene mixed_scene()
{
    Scene scene = scene_of_shapes();
    const glm::mat4 one(1.0f);
    add_instance(scene, kCube);
    add_instance(scene, kCube, glm::rotate(one, 0.7f, glm::normalize(glm::vec3(1, 2, 3))));
    add_instance(scene, kCube, glm::scale(one, glm::vec3(-1.0f, 2.0f, 3.0f)));
    add_instance(scene, kBall, glm::translate(one, glm::vec3(5.0f)));
    add_instance(scene, kBall, glm::scale(one, glm::vec3(0.3f, -0.3f, 0.3f)));
    add_instance(scene, kRamp, glm::scale(one, glm::vec3(0.5f)));
    return scene;
}

Polygon in_atlas(const Surface& surface, std::size_t triangle)
{
    return {glm::dvec2(surface.texcoord[surface.indices[3 * triangle]]),
            glm::dvec2(surface.texcoord[surface.indices[3 * triangle + 1]]),
            glm::dvec2(surface.texcoord[surface.indices[3 * triangle + 2]])};
}

TEST(MakeAtlas, GivesAWallOneChartAndABoxSix)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {quad(3.0f, 2.0f)}));
    EXPECT_EQ(make_atlas(scene, {}).chart_count, 1u);
    add_instance(scene, add_mesh(scene, {box({1.0f, 2.0f, 3.0f})}));
    EXPECT_EQ(make_atlas(scene, {}).chart_count, 7u);
}

TEST(MakeAtlas, GivesRoundThingsAHandfulOfCharts)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {sphere(48, 24)}));
    EXPECT_LE(make_atlas(scene, {}).chart_count, 16u);
    Scene pipe = empty_scene();
    add_instance(pipe, add_mesh(pipe, {tube(32, 3.0f)}));
    EXPECT_LE(make_atlas(pipe, {}).chart_count, 6u);
}

TEST(MakeAtlas, AlignsTheEdgesOfRectanglesWithTexels)
{
    Scene scene = empty_scene();
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), 0.9f, glm::vec3(0.48f, 0.6f, 0.64f));
    add_instance(scene, add_mesh(scene, {quad(3.3f, 2.1f)}), turned);
    const Atlas atlas = make_atlas(scene, {.texels_per_metre = 10.0f});
    for (const glm::vec2& place : atlas.surfaces[0].texcoord)
        EXPECT_EQ(place, glm::round(place));
    const Polygon triangle = in_atlas(atlas.surfaces[0], 0);
    EXPECT_EQ(triangle.high() - triangle.low(), glm::dvec2(33.0, 21.0));
}

TEST(MakeAtlas, NeverLetsTwoChartsTouchInABilinearLookup)
{
    for (const int gutter : {2, 3, 4}) {
        const Atlas atlas = make_atlas(mixed_scene(), {.size = 256, .gutter = gutter});
        int shared = 0;
        const std::vector<int> owner = texel_owners(atlas, shared);
        EXPECT_EQ(shared, 0);
        int close = 0;
        for (int y = 0; y < atlas.height; ++y)
            for (int x = 0; x < atlas.width; ++x)
                for (int dy = -gutter; dy <= gutter; ++dy)
                    for (int dx = -gutter; dx <= gutter; ++dx) {
                        // The map may be tiled: its opposite sides are neighbours.
                        const int u = (x + dx + atlas.width) % atlas.width;
                        const int v = (y + dy + atlas.height) % atlas.height;
                        const int here = owner[std::size_t(y) * atlas.width + x];
                        const int there = owner[std::size_t(v) * atlas.width + u];
                        close += here >= 0 && there >= 0 && here != there;
                    }
        EXPECT_EQ(close, 0) << "gutter " << gutter;
    }
}

TEST(MakeAtlas, NeverMirrorsAChart)
{
    const Scene scene = mixed_scene();
    for (const Surface& surface : make_atlas(scene, {}).surfaces) {
        const bool flips =
            glm::determinant(glm::mat3(scene.instances[surface.instance].transform)) < 0.0f;
        for (std::size_t t = 0; t < surface.chart.size(); ++t) {
            // Counter-clockwise from the front is clockwise where v runs down.
            const double area = in_atlas(surface, t).signed_area();
            EXPECT_LT(flips ? -area : area, 0.0);
        }
    }
}

TEST(MakeAtlas, NeverLaysAChartOverItself)
{
    const Atlas atlas = make_atlas(mixed_scene(), {.size = 1024});
    for (const Surface& surface : atlas.surfaces)
        for (std::size_t a = 0; a < surface.chart.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                EXPECT_LT(common_area(in_atlas(surface, a), in_atlas(surface, b)), 0.02);
}

TEST(MakeAtlas, GivesEveryInstanceAPlaceOfItsOwn)
{
    Scene scene = empty_scene();
    const int mesh = add_mesh(scene, {quad(1.0f, 1.0f)});
    for (int i = 0; i < 5; ++i)
        add_instance(scene, mesh, glm::translate(glm::mat4(1.0f), glm::vec3(2.0f * float(i))));
    const Atlas atlas = make_atlas(scene, {});
    ASSERT_EQ(atlas.surfaces.size(), 5u);
    EXPECT_EQ(atlas.chart_count, 5u);
    int shared = 0;
    texel_owners(atlas, shared);
    EXPECT_EQ(shared, 0);
}

TEST(MakeAtlas, GivesEqualSurfaceEqualRoomWhateverItsScale)
{
    Scene scene = empty_scene();
    const int mesh = add_mesh(scene, {quad(1.0f, 1.0f)});
    add_instance(scene, mesh, glm::scale(glm::mat4(1.0f), glm::vec3(4.0f, 2.0f, 1.0f)));
    const Atlas atlas = make_atlas(scene, {.texels_per_metre = 8.0f});
    const Polygon triangle = in_atlas(atlas.surfaces[0], 0);
    EXPECT_EQ(triangle.high() - triangle.low(), glm::dvec2(32.0, 16.0));
}

TEST(MakeAtlas, KeepsTheTrianglesAndTheirOrder)
{
    const Scene scene = mixed_scene();
    for (const Surface& surface : make_atlas(scene, {}).surfaces) {
        const Primitive& primitive =
            scene.meshes[scene.instances[surface.instance].mesh].primitives[surface.primitive];
        ASSERT_EQ(surface.indices.size(), primitive.indices.size());
        for (std::size_t i = 0; i < primitive.indices.size(); ++i)
            EXPECT_EQ(surface.source_vertex[surface.indices[i]], primitive.indices[i]);
    }
}

TEST(MakeAtlas, IsTheSameByteForByteEveryTime)
{
    const Atlas a = make_atlas(mixed_scene(), {.size = 300}),
                b = make_atlas(mixed_scene(), {.size = 300});
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    for (std::size_t s = 0; s < a.surfaces.size(); ++s) {
        ASSERT_EQ(a.surfaces[s].texcoord.size(), b.surfaces[s].texcoord.size());
        EXPECT_EQ(std::memcmp(a.surfaces[s].texcoord.data(), b.surfaces[s].texcoord.data(),
                              a.surfaces[s].texcoord.size() * sizeof(glm::vec2)),
                  0);
        EXPECT_EQ(a.surfaces[s].chart, b.surfaces[s].chart);
        EXPECT_EQ(a.surfaces[s].indices, b.surfaces[s].indices);
    }
}

TEST(MakeAtlas, HasTheSizeAskedFor)
{
    for (const int size : {64, 100, 128, 777}) {
        const Atlas atlas = make_atlas(mixed_scene(), {.size = size});
        EXPECT_EQ(atlas.width, size);
        EXPECT_EQ(atlas.height, size);
        EXPECT_GT(atlas.texels_per_metre, 0.0f);
    }
}

TEST(MakeAtlas, FillsMostOfTheSizeAskedFor)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {box({1.0f, 1.0f, 1.0f})}));
    const Atlas atlas = make_atlas(scene, {.size = 128});
    int shared = 0, used = 0;
    for (const int owner : texel_owners(atlas, shared))
        used += owner >= 0;
    EXPECT_GT(used, 128 * 128 * 55 / 100);
}

/// A flat rectangular frame, one metre a side, its bars as wide as given.
Primitive frame(float bar)
{
    Primitive primitive;
    for (const float inset : {0.0f, bar})
        for (const glm::vec2& corner :
             {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
            primitive.positions.emplace_back(inset + corner * (1.0f - 2.0f * inset), 0.0f);
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        for (const std::uint32_t vertex : {i, next, 4 + next, i, 4 + next, 4 + i})
            primitive.indices.push_back(vertex);
    }
    return primitive;
}

TEST(MakeAtlas, DividesAThinFrameButNotABroadOne)
{
    Scene thin = empty_scene(), broad = empty_scene();
    add_instance(thin, add_mesh(thin, {frame(0.02f)}));
    add_instance(broad, add_mesh(broad, {frame(0.3f)}));
    EXPECT_EQ(make_atlas(thin, {.texels_per_metre = 100.0f}).chart_count, 4u);
    EXPECT_EQ(make_atlas(broad, {.texels_per_metre = 100.0f}).chart_count, 1u);
}

TEST(MakeAtlas, LetsManyLeavesShareATexel)
{
    // A thousand leaves of 1 cm within 20 cm, at 10 cm a texel.
    Primitive leaves;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const glm::vec3 at(0.02f * float(i % 10), 0.02f * float(i / 10 % 10),
                           0.02f * float(i / 100));
        for (const glm::vec3& corner :
             {glm::vec3(0), glm::vec3(0.01f, 0, 0), glm::vec3(0, 0.01f, 0.003f)})
            leaves.positions.push_back(at + corner);
        for (const std::uint32_t corner : {0u, 1u, 2u})
            leaves.indices.push_back(3 * i + corner);
    }
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {leaves}));
    add_instance(scene, add_mesh(scene, {quad(3.0f, 3.0f)}));
    const Atlas atlas = make_atlas(scene, {.texels_per_metre = 10.0f});
    EXPECT_LE(atlas.chart_count, 30u);
    const Lumels lumels = make_lumels(scene, atlas);
    EXPECT_NEAR(front_area(lumels) / world_area(scene), 1.0, 1e-5);
    for (const Lumel& lumel : lumels.lumels)
        EXPECT_LT(lumel.size, 0.2f);
}

TEST(MakeAtlas, ScalesTheDensityToTheLargestSizeAndSaysSo)
{
    const Atlas atlas = make_atlas(mixed_scene(), {.texels_per_metre = 500.0f, .max_size = 256});
    EXPECT_LE(atlas.width, 256);
    EXPECT_LT(atlas.texels_per_metre, 500.0f);
    ASSERT_EQ(atlas.notes.size(), 1u);
    EXPECT_NE(atlas.notes[0].find("texels per metre"), std::string::npos);
    EXPECT_TRUE(make_atlas(mixed_scene(), {.texels_per_metre = 5.0f}).notes.empty());
}

TEST(MakeAtlas, RefusesWhatCannotFit)
{
    EXPECT_THROW(make_atlas(mixed_scene(), {.size = 4}), Error);
    EXPECT_THROW(make_atlas(empty_scene(), {}), Error);
    EXPECT_THROW(make_atlas(mixed_scene(), {.size = -1}), Error);
}

}  // namespace
}  // namespace lumel::test
