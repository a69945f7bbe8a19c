// Several quantities of one solution, finished alike.

#include <gtest/gtest.h>

#include "atlas/finish/finish.h"
#include "grid_lumels.h"

namespace lumel {
namespace {

using test::grid;
using test::rgb;

std::vector<glm::vec3> grey(const std::vector<float>& values)
{
    return {values.begin(), values.end()};
}

/// Gives a chart a back side, after all fronts.
Lumels with_backs(Lumels lumels, std::uint32_t chart)
{
    for (Lumel back : std::vector<Lumel>(lumels.lumels))
        if (back.chart == chart) {
            back.flags |= kLumelBack;
            lumels.lumels.push_back(back);
        }
    return lumels;
}

FinishedMaps finish(const Lumels& lumels, const std::vector<float>& light,
                    const std::vector<float>& layer)
{
    Atlas atlas;
    atlas.width = lumels.width;
    atlas.height = lumels.height;
    const std::vector<std::vector<glm::vec3>> layers = {grey(layer)};
    return finish_maps(Scene{}, atlas, lumels, grey(light), layers);
}

TEST(FinishMaps, LayersShowTheSideThatTheLightChooses)
{
    const Lumels lumels = with_backs(grid({"aa"}), 0);
    const FinishedMaps maps =
        finish(lumels, {1.0f, 2.0f, 5.0f, 6.0f}, {100.0f, 200.0f, -3.0f, -4.0f});
    EXPECT_EQ(maps.light.at(0, 0)[0], 5.0f);
    EXPECT_EQ(maps.layers[0].at(0, 0)[0], -3.0f);
    EXPECT_EQ(maps.layers[0].at(1, 0)[0], -4.0f);
    EXPECT_EQ(maps.layers[0].at(1, 0)[3], maps.light.at(1, 0)[3]);
}

TEST(FinishMaps, LayersAreFilledWhereTheLightIsAndKeepTheirSign)
{
    const Lumels lumels = grid({"aaA."});
    const FinishedMaps maps = finish(lumels, {7.0f, 7.0f, 0.0f}, {-2.0f, -2.0f, 0.0f});
    for (int x = 0; x < 4; ++x) {
        EXPECT_EQ(rgb(maps.light, x, 0), glm::vec3(7.0f)) << x;
        EXPECT_EQ(rgb(maps.layers[0], x, 0), glm::vec3(-2.0f)) << x;
    }
}

// A layer's own black is no reason to fill it.
TEST(FinishMaps, AnOpenTexelsLayerStaysBlackIfItIs)
{
    Lumels lumels = grid({"aA"});
    Lumel back = lumels.lumels[1];  // open behind the buried front
    back.flags = kLumelBack;
    lumels.lumels.push_back(back);
    back.texel = 0;
    lumels.lumels.push_back(back);
    const FinishedMaps maps = finish(lumels, {1.0f, 0.0f, 5.0f, 6.0f}, {9.0f, 9.0f, 0.0f, 3.0f});
    EXPECT_EQ(maps.light.at(1, 0)[0], 5.0f);
    EXPECT_EQ(maps.layers[0].at(1, 0)[0], 0.0f);
}

TEST(FinishSides, EachShowsItsSideOfDoubleSidedSurfacesAndTheOnlyOneOfOthers)
{
    const Lumels lumels = with_backs(grid({"aab"}), 0);
    Atlas atlas;
    atlas.width = lumels.width;
    atlas.height = lumels.height;
    const SideMaps maps =
        finish_sides(Scene{}, atlas, lumels, grey({1.0f, 2.0f, 3.0f, 0.0f, 6.0f}));
    EXPECT_EQ(rgb(maps.front, 0, 0), glm::vec3(1.0f));
    EXPECT_EQ(rgb(maps.front, 1, 0), glm::vec3(2.0f));
    EXPECT_EQ(rgb(maps.back, 0, 0), glm::vec3(0.0f));
    EXPECT_EQ(rgb(maps.back, 1, 0), glm::vec3(6.0f));
    EXPECT_EQ(rgb(maps.front, 2, 0), glm::vec3(3.0f));
    EXPECT_EQ(rgb(maps.back, 2, 0), glm::vec3(3.0f));
}

TEST(FinishSides, ThereIsNoBackMapIfNothingIsDoubleSided)
{
    Atlas atlas;
    atlas.width = atlas.height = 1;
    const SideMaps maps = finish_sides(Scene{}, atlas, grid({"a"}), grey({4.0f}));
    EXPECT_EQ(rgb(maps.front, 0, 0), glm::vec3(4.0f));
    EXPECT_TRUE(maps.back.values.empty());
}

}  // namespace
}  // namespace lumel
