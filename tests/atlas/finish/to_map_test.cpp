#include <gtest/gtest.h>

#include "atlas/finish/finish.h"
#include "grid_lumels.h"

namespace lumel {
namespace {

using test::grid;
using test::rgb;

// The chart's lumels again, as its back side.
Lumels with_backs(Lumels lumels)
{
    const std::vector<Lumel> fronts = lumels.lumels;
    for (Lumel back : fronts) {
        back.flags |= kLumelBack;
        lumels.lumels.push_back(back);
    }
    return lumels;
}

TEST(ToMap, PutsEachValueIntoItsTexelAndCoverageIntoAlpha)
{
    Lumels lumels = grid({"a.", ".b"});
    lumels.coverage[3] = 0.25f;
    const std::vector<glm::vec3> values = {{1, 2, 3}, {4, 5, 6}};
    const Image map = to_map(lumels, values);
    EXPECT_EQ(rgb(map, 0, 0), values[0]);
    EXPECT_EQ(rgb(map, 1, 1), values[1]);
    EXPECT_EQ(map.at(0, 0)[3], 1.0f);
    EXPECT_EQ(map.at(1, 1)[3], 0.25f);
    EXPECT_EQ(rgb(map, 1, 0), glm::vec3(0.0f));
    EXPECT_EQ(map.at(1, 0)[3], 0.0f);
}

TEST(ToMap, ValidBlackDiffersFromNotCoveredEvenIn8Bits)
{
    Lumels lumels = grid({"a."});
    lumels.coverage[0] = 1e-6f;
    const Image map = to_map(lumels, std::vector<glm::vec3>{glm::vec3(0.0f)});
    EXPECT_GE(map.at(0, 0)[3], 1.0f / 255.0f);
    EXPECT_EQ(map.at(1, 0)[3], 0.0f);
}

TEST(ToMap, ADoubleSidedChartShowsItsBrighterSideAsAWhole)
{
    const Lumels lumels = with_backs(grid({"aabb"}));
    // Chart a: front 3 + 1, back 2 + 4; chart b: front 5 + 5, back 6 + 0.
    std::vector<glm::vec3> values;
    for (const float value : {3.0f, 1.0f, 5.0f, 5.0f, 2.0f, 4.0f, 6.0f, 0.0f})
        values.emplace_back(value);
    const Image map = to_map(lumels, values);
    EXPECT_EQ(map.at(0, 0)[0], 2.0f);
    EXPECT_EQ(map.at(1, 0)[0], 4.0f);
    EXPECT_EQ(map.at(2, 0)[0], 5.0f);
    EXPECT_EQ(map.at(3, 0)[0], 5.0f);
}

TEST(ToMap, AFrontLitAtItsRimShowsBeforeFaintLightInside)
{
    const Lumels lumels = with_backs(grid({"aaaa"}));
    std::vector<glm::vec3> values;
    for (const float value : {9.0f, 0.0f, 0.0f, 0.0f, 3.0f, 3.0f, 3.0f, 3.0f})
        values.emplace_back(value);
    EXPECT_EQ(to_map(lumels, values).at(0, 0)[0], 9.0f);
}

TEST(ToMap, EqualSidesShowTheFront)
{
    const Lumels lumels = with_backs(grid({"a"}));
    const Image map = to_map(lumels, std::vector<glm::vec3>{{0.5f, 0, 0}, {0.5f, 0, 0}});
    EXPECT_EQ(map.at(0, 0)[0], 0.5f);
}

TEST(ToMap, BuriedLumelsHaveNoSayInTheChoiceOfSides)
{
    // The front is half buried, but brighter than the back where light can reach it.
    const Lumels lumels = with_backs(grid({"aA"}));
    std::vector<glm::vec3> values;
    for (const float value : {3.0f, 0.0f, 2.0f, 2.0f})
        values.emplace_back(value);
    EXPECT_EQ(to_map(lumels, values).at(0, 0)[0], 3.0f);
}

}  // namespace
}  // namespace lumel
