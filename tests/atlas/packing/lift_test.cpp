#include <algorithm>
#include <cstring>
#include <map>
#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "atlas/lumels/sampling.h"
#include "shapes.h"

namespace lumel::test {
namespace {

Scene turned_shapes()
{
    Scene scene = scene_of_shapes();
    const glm::mat4 one(1.0f);
    const glm::vec3 axis = glm::normalize(glm::vec3(1, 2, 3));
    add_instance(scene, kCube, glm::translate(glm::rotate(one, 0.7f, axis), glm::vec3(9, 0, 4)));
    add_instance(scene, kCube, glm::scale(glm::rotate(one, 1.9f, axis), glm::vec3(-1, 2, 3)));
    add_instance(scene, kBall, glm::scale(glm::rotate(one, 0.3f, axis), glm::vec3(1, 0.4f, 2)));
    add_instance(scene, kRamp, glm::scale(one, glm::vec3(0.5f, 0.5f, -0.5f)));
    return scene;
}

/// A quad with texture coordinates 0…1 (v down) in set 0, and a texture of this many texels.
Scene textured_quad(int width, int height, const std::vector<std::uint8_t>& rgba)
{
    Scene scene = empty_scene();
    scene.textures.push_back({width, height, rgba});
    scene.materials[0].base_color_texture.texture = 0;
    Primitive primitive = quad(1.0f, 1.0f);
    primitive.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    add_instance(scene, add_mesh(scene, {primitive}));
    return scene;
}

std::vector<std::uint8_t> checkerboard(int side, std::uint8_t alpha_of_black)
{
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const bool white = (x + y) % 2 == 0;
            for (int c = 0; c < 3; ++c)
                rgba.push_back(white ? 255 : 0);
            rgba.push_back(white ? 255 : alpha_of_black);
        }
    return rgba;
}

TEST(Lift, CoversTheWholeSurfaceAtEverySize)
{
    const Scene scene = turned_shapes();
    const double expected = world_area(scene);
    for (const int size : {48, 128, 512}) {
        const Lumels lumels = make_lumels(scene, make_atlas(scene, {.size = size}));
        EXPECT_NEAR(front_area(lumels) / expected, 1.0, 1e-4) << size;
    }
}

TEST(Lift, KeepsTrianglesFarSmallerThanATexel)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {sphere(256, 128)}),
                 glm::scale(glm::mat4(1.0f), glm::vec3(0.001f)));
    add_instance(scene, add_mesh(scene, {quad(4.0f, 4.0f)}));
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.size = 64}));
    double small = 0.0;
    for (const Lumel& lumel : lumels.lumels)
        small += lumel.instance == 0 ? lumel.area : 0.0;
    Scene ball = scene;
    ball.instances.resize(1);
    EXPECT_NEAR(small / world_area(ball), 1.0, 1e-3);
}

TEST(Lift, MakesOneParallelogramOfAFullTexelOfAWall)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {quad(3.0f, 2.0f)}),
                 glm::rotate(glm::mat4(1.0f), 0.9f, glm::vec3(0.48f, 0.6f, 0.64f)));
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.texels_per_metre = 7.0f}));
    ASSERT_EQ(lumels.lumels.size(), 21u * 14u);
    EXPECT_EQ(lumels.pieces.size(), lumels.lumels.size());
    for (const Lumel& lumel : lumels.lumels) {
        EXPECT_EQ(lumels.pieces[lumel.first_piece].parallelogram, 1u);
        EXPECT_NEAR(lumel.area, 1.0 / 49.0, 1e-6);
        EXPECT_NEAR(lumel.size, 1.0 / 7.0, 1e-5);
        EXPECT_EQ(lumels.coverage[lumel.texel], 1.0f);
    }
}

TEST(Lift, CountsPartlyCoveredTexels)
{
    Scene scene = empty_scene();
    Primitive triangle = quad(1.0f, 1.0f);
    triangle.indices = {0, 1, 2};
    add_instance(scene, add_mesh(scene, {triangle}));
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.texels_per_metre = 8.0f}));
    EXPECT_NEAR(front_area(lumels), 0.5, 1e-6);
    const auto partly = std::count_if(lumels.coverage.begin(), lumels.coverage.end(),
                                      [](float c) { return c > 0.0f && c < 0.999f; });
    EXPECT_GT(partly, 0);
}

TEST(Lift, PutsPiecesOnTheirSurface)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {sphere(24, 12)}),
                 glm::scale(glm::mat4(1.0f), glm::vec3(1.0f, 2.0f, -1.0f)));
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.size = 64}));
    // Facets of this sphere lie between its inner and its outer radius.
    for (const Piece& piece : lumels.pieces) {
        const float at = piece.parallelogram ? 0.5f : 1.0f / 3.0f;
        const glm::vec3 centre = piece.origin + at * (piece.edge_u + piece.edge_v);
        EXPECT_GT(glm::length(centre), 0.97f);
        EXPECT_LT(glm::length(centre), 1.0001f);
        EXPECT_GT(glm::dot(glm::cross(piece.edge_u, piece.edge_v), centre), 0.0f);
        EXPECT_NEAR(glm::length(piece.normal), 1.0f, 1e-5f);
        EXPECT_GT(glm::dot(piece.normal, glm::normalize(centre)), 0.99f);
    }
}

TEST(Lift, DrawsPointsUniformlyByArea)
{
    const Scene scene = turned_shapes();
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.size = 64}));
    constexpr int kSide = 64;
    for (std::size_t i = 0; i < lumels.lumels.size(); i += 97) {
        const Lumel& lumel = lumels.lumels[i];
        glm::dvec3 mean(0.0), centroid(0.0);
        for (int s = 0; s < kSide * kSide; ++s)
            mean += glm::dvec3(point_on(lumels, lumel, (float(s) + 0.5f) / (kSide * kSide),
                                        float(s * 1741 % 4096) / 4096.0f + 1.0f / 8192.0f)
                                   .position);
        mean /= double(kSide * kSide);
        double below = 0.0;
        for (std::uint32_t p = 0; p < lumel.piece_count; ++p) {
            const Piece& piece = lumels.pieces[lumel.first_piece + p];
            const double at = piece.parallelogram ? 0.5 : 1.0 / 3.0;
            centroid += (piece.share - below) *
                        (glm::dvec3(piece.origin) + at * glm::dvec3(piece.edge_u + piece.edge_v));
            below = piece.share;
        }
        EXPECT_LT(glm::distance(mean, centroid), 0.01 * lumel.size + 1e-6);
    }
}

TEST(Lift, SharesAreProportionalToTheAreasOfPieces)
{
    const Scene scene = turned_shapes();
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.size = 128}));
    for (const Lumel& lumel : lumels.lumels) {
        const glm::dmat3 to_world(scene.instances[lumel.instance].transform);
        double whole = 0.0, running = 0.0;
        std::vector<double> areas;
        for (std::uint32_t p = 0; p < lumel.piece_count; ++p) {
            const Piece& piece = lumels.pieces[lumel.first_piece + p];
            areas.push_back(glm::length(glm::cross(to_world * glm::dvec3(piece.edge_u),
                                                   to_world * glm::dvec3(piece.edge_v))) *
                            (piece.parallelogram ? 1.0 : 0.5));
            whole += areas.back();
        }
        for (std::uint32_t p = 0; p < lumel.piece_count; ++p) {
            running += areas[p];
            EXPECT_NEAR(lumels.pieces[lumel.first_piece + p].share, running / whole, 2e-3);
        }
        if (lumel.piece_count < 32) {
            EXPECT_NEAR(whole / lumel.area, 1.0, 2e-3);
        }
    }
}

TEST(Lift, PutsPositionsOnTheSurfaceAlsoWhereItIsBent)
{
    // A gutter of two planes at 35 degrees to each other, coarser than its bend.
    Scene scene = empty_scene();
    Primitive bent;
    bent.positions = {{-1, 0.315f, 0}, {0, 0, 0}, {1, 0.315f, 0},
                      {-1, 0.315f, 3}, {0, 0, 3}, {1, 0.315f, 3}};
    bent.indices = {0, 3, 4, 0, 4, 1, 1, 4, 5, 1, 5, 2};
    add_instance(scene, add_mesh(scene, {bent}));
    for (const Lumel& lumel :
         make_lumels(scene, make_atlas(scene, {.texels_per_metre = 0.5f})).lumels)
        EXPECT_NEAR(lumel.position.y, 0.315f * std::abs(lumel.position.x), 1e-5f);
}

TEST(Lift, EndsTheSharesOfEveryLumelAtOne)
{
    const Scene scene = turned_shapes();
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.size = 64}));
    for (const Lumel& lumel : lumels.lumels) {
        ASSERT_GE(lumel.piece_count, 1u);
        float below = 0.0f;
        for (std::uint32_t p = 0; p < lumel.piece_count; ++p) {
            EXPECT_GE(lumels.pieces[lumel.first_piece + p].share, below);
            below = lumels.pieces[lumel.first_piece + p].share;
        }
        EXPECT_EQ(below, 1.0f);
    }
}

TEST(Lift, GivesDoubleSidedSurfacesABackWithOppositeNormals)
{
    Scene scene = empty_scene();
    scene.materials[0].double_sided = true;
    add_instance(scene, add_mesh(scene, {quad(1.0f, 1.0f)}));
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.texels_per_metre = 8.0f}));
    ASSERT_EQ(lumels.lumels.size(), 128u);
    for (int i = 0; i < 64; ++i) {
        const Lumel &front = lumels.lumels[i], &back = lumels.lumels[64 + i];
        EXPECT_EQ(front.flags, 0u);
        EXPECT_EQ(back.flags, kLumelBack);
        EXPECT_EQ(back.texel, front.texel);
        EXPECT_EQ(back.normal, -front.normal);
        EXPECT_EQ(back.area, front.area);
        const Piece& piece = lumels.pieces[back.first_piece];
        EXPECT_GT(glm::dot(glm::cross(piece.edge_u, piece.edge_v), back.normal), 0.0f);
    }
}

TEST(Lift, FacesTheVisibleSideOfMirroredInstances)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {quad(1.0f, 1.0f)}),
                 glm::scale(glm::mat4(1.0f), glm::vec3(-1.0f, 1.0f, 1.0f)));
    for (const Lumel& lumel : make_lumels(scene, make_atlas(scene, {.size = 16})).lumels)
        EXPECT_EQ(lumel.normal, glm::vec3(0, 0, 1));
}

TEST(Lift, UsesTheGeometricNormalWhereVertexNormalsAreNonsense)
{
    Scene scene = empty_scene();
    Primitive primitive = quad(1.0f, 1.0f);
    primitive.normals.assign(4, glm::vec3(0, 0, -1));
    add_instance(scene, add_mesh(scene, {primitive}));
    for (const Lumel& lumel : make_lumels(scene, make_atlas(scene, {.size = 16})).lumels)
        EXPECT_EQ(lumel.normal, glm::vec3(0, 0, 1));
}

TEST(Lift, AveragesATextureOverTheLumel)
{
    Scene scene = textured_quad(64, 64, checkerboard(64, 255));
    scene.max_albedo = 1.0f;
    for (const Lumel& lumel :
         make_lumels(scene, make_atlas(scene, {.texels_per_metre = 16.0f})).lumels)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(lumel.albedo[c], 0.5f, 0.02f);
    // Also where a lumel is far coarser than its texture.
    for (const Lumel& lumel :
         make_lumels(scene, make_atlas(scene, {.texels_per_metre = 1.0f})).lumels)
        EXPECT_NEAR(lumel.albedo.x, 0.5f, 0.08f);
}

TEST(Lift, CountsOnlyWhatAMaskLeaves)
{
    Scene scene = textured_quad(64, 64, checkerboard(64, 0));
    scene.materials[0].alpha_mode = AlphaMode::mask;
    scene.materials[0].alpha_cutoff = 0.5f;
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.texels_per_metre = 16.0f}));
    EXPECT_NEAR(front_area(lumels), 0.5, 0.05);
    for (const Lumel& lumel : lumels.lumels)
        EXPECT_NEAR(lumels.coverage[lumel.texel], 0.5f, 0.1f);
}

TEST(Lift, MakesNoLumelWhereAllIsCutOut)
{
    Scene scene = textured_quad(1, 1, {255, 255, 255, 0});
    scene.materials[0].alpha_mode = AlphaMode::mask;
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.texels_per_metre = 8.0f}));
    EXPECT_TRUE(lumels.lumels.empty());
    EXPECT_EQ(*std::max_element(lumels.coverage.begin(), lumels.coverage.end()), 0.0f);
}

TEST(Lift, EmitsPiTimesTheLuminance)
{
    Scene scene = empty_scene();
    scene.materials[0].emitted = {1.0f, 2.0f, 3.0f};
    add_instance(scene, add_mesh(scene, {quad(1.0f, 1.0f)}));
    for (const Lumel& lumel : make_lumels(scene, make_atlas(scene, {.size = 16})).lumels)
        EXPECT_NEAR(glm::distance(lumel.emission, 3.14159265f * glm::vec3(1, 2, 3)), 0.0f, 1e-5f);
}

TEST(Lift, OrdersLumelsByChartAndFrontsBeforeBacks)
{
    Scene scene = turned_shapes();
    scene.materials[0].double_sided = true;
    const Lumels lumels = make_lumels(scene, make_atlas(scene, {.size = 128}));
    for (std::size_t i = 1; i < lumels.lumels.size(); ++i) {
        const Lumel &before = lumels.lumels[i - 1], &lumel = lumels.lumels[i];
        EXPECT_LE(before.chart, lumel.chart);
        if (before.chart == lumel.chart) {
            EXPECT_LE(before.flags & kLumelBack, lumel.flags & kLumelBack);
        }
    }
}

TEST(Lift, IsTheSameByteForByteEveryTime)
{
    const Scene scene = turned_shapes();
    const Atlas atlas = make_atlas(scene, {.size = 256});
    const Lumels a = make_lumels(scene, atlas), b = make_lumels(scene, atlas);
    ASSERT_EQ(a.lumels.size(), b.lumels.size());
    ASSERT_EQ(a.pieces.size(), b.pieces.size());
    EXPECT_EQ(std::memcmp(a.lumels.data(), b.lumels.data(), a.lumels.size() * sizeof(Lumel)), 0);
    EXPECT_EQ(std::memcmp(a.pieces.data(), b.pieces.data(), a.pieces.size() * sizeof(Piece)), 0);
    EXPECT_EQ(a.coverage, b.coverage);
}

}  // namespace
}  // namespace lumel::test
