#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "shapes.h"

namespace lumel::test {
namespace {

/// A quad whose TEXCOORD_1 fills low…high.
Primitive laid_out_quad(const glm::vec2& low, const glm::vec2& high)
{
    Primitive primitive = quad(1.0f, 1.0f);
    primitive.texcoords[1] = {{low.x, high.y}, {high.x, high.y}, {high.x, low.y}, {low.x, low.y}};
    return primitive;
}

TEST(Authored, KeepsALayoutOfTheWholeSceneAsItIs)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {laid_out_quad({0.0f, 0.0f}, {0.5f, 0.5f})}));
    add_instance(scene, add_mesh(scene, {laid_out_quad({0.5f, 0.5f}, {1.0f, 1.0f})}));
    const Atlas atlas = make_atlas(scene, {.size = 64});
    EXPECT_TRUE(atlas.notes.empty());
    for (const Surface& surface : atlas.surfaces) {
        EXPECT_TRUE(surface.authored);
        const Primitive& primitive = scene.meshes[surface.instance].primitives[0];
        for (std::size_t v = 0; v < surface.texcoord.size(); ++v)
            EXPECT_EQ(surface.texcoord[v], 64.0f * primitive.texcoords[1][v]);
    }
}

TEST(Authored, GivesInstancesOfALaidOutMeshTheirOwnPlaces)
{
    Scene scene = empty_scene();
    const int mesh = add_mesh(scene, {laid_out_quad({0.0f, 0.0f}, {1.0f, 1.0f})});
    add_instance(scene, mesh);
    add_instance(scene, mesh, glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 0.0f, 2.0f)));
    const Atlas atlas = make_atlas(scene, {.texels_per_metre = 16.0f});
    int shared = 0, used = 0;
    for (const int owner : texel_owners(atlas, shared))
        used += owner >= 0;
    EXPECT_EQ(shared, 0);
    EXPECT_EQ(used, 2 * 16 * 16);
    EXPECT_TRUE(atlas.surfaces[0].authored);
    EXPECT_TRUE(atlas.surfaces[1].authored);
}

TEST(Authored, ReportsAnOverlapWithTheMeshAndHowMuch)
{
    // The second half of the first quad lies under the second: a third of all area, once.
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene,
                                 {laid_out_quad({0.0f, 0.0f}, {0.4f, 0.2f}),
                                  laid_out_quad({0.3f, 0.0f}, {0.7f, 0.2f})},
                                 "chair"));
    const Atlas atlas = make_atlas(scene, {.size = 64});
    ASSERT_EQ(atlas.notes.size(), 1u);
    EXPECT_NE(atlas.notes[0].find("chair"), std::string::npos);
    EXPECT_NE(atlas.notes[0].find("12.5 per cent"), std::string::npos) << atlas.notes[0];
    EXPECT_FALSE(atlas.surfaces[0].authored);
}

TEST(Authored, ReportsALayoutThatLeavesTheUnitSquare)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {laid_out_quad({0.0f, 0.0f}, {3.0f, 1.0f})}, "floor"));
    const Atlas atlas = make_atlas(scene, {.size = 64});
    ASSERT_EQ(atlas.notes.size(), 1u);
    EXPECT_NE(atlas.notes[0].find("floor"), std::string::npos);
    EXPECT_NE(atlas.notes[0].find("0…1"), std::string::npos);
    EXPECT_FALSE(atlas.surfaces[0].authored);
}

TEST(Authored, ForgivesRounding)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {laid_out_quad({-1e-6f, 0.0f}, {0.50001f, 1.000001f}),
                                         laid_out_quad({0.5f, 0.0f}, {1.0f, 1.0f})}));
    const Atlas atlas = make_atlas(scene, {.size = 64});
    EXPECT_TRUE(atlas.notes.empty());
    EXPECT_TRUE(atlas.surfaces[0].authored);
}

TEST(Authored, RefusesALayoutWithoutRoom)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {laid_out_quad({0.0f, 0.0f}, {0.0f, 0.0f})}));
    const Atlas atlas = make_atlas(scene, {.size = 64});
    EXPECT_EQ(atlas.notes.size(), 1u);
    EXPECT_FALSE(atlas.surfaces[0].authored);
    EXPECT_NEAR(front_area(make_lumels(scene, atlas)), 1.0, 1e-5);
}

TEST(Authored, ReportsAStackOfTrianglesQuickly)
{
    Scene scene = empty_scene();
    std::vector<Primitive> tiles(2000, laid_out_quad({0.0f, 0.0f}, {1.0f, 1.0f}));
    add_instance(scene, add_mesh(scene, std::move(tiles), "tiles"));
    const Atlas atlas = make_atlas(scene, {.size = 512});
    ASSERT_EQ(atlas.notes.size(), 1u);
    EXPECT_NE(atlas.notes[0].find("at least"), std::string::npos);
}

}  // namespace
}  // namespace lumel::test
