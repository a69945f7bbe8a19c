#include <gtest/gtest.h>

#include "atlas/finish/finish.h"
#include "grid_lumels.h"

namespace lumel {
namespace {

using test::grid;
using test::rgb;

Image filled(const Lumels& lumels, const std::vector<glm::vec3>& values)
{
    Image map = to_map(lumels, values);
    fill_buried(map, lumels, shown_lumels(lumels, values));
    return map;
}

Image filled(const Lumels& lumels, float open_light)
{
    std::vector<glm::vec3> values;
    for (const Lumel& lumel : lumels.lumels)
        values.emplace_back(lumel.flags & kLumelBuried ? 0.0f : open_light);
    return filled(lumels, values);
}

/// Adds the backs of all lumels, which share their texels.
void add_backs(Lumels& lumels, std::uint32_t flags)
{
    for (Lumel back : std::vector<Lumel>(lumels.lumels)) {
        back.flags = kLumelBack | flags;
        lumels.lumels.push_back(back);
    }
}

TEST(FillBuried, BuriedTexelsTakeTheLightAroundThem)
{
    const Lumels lumels = grid({"aaaaa", "aAAAa", "aAAAa", "aAAAa", "aaaaa"});
    const Image map = filled(lumels, 7.0f);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x)
            EXPECT_EQ(rgb(map, x, y), glm::vec3(7.0f));
}

TEST(FillBuried, OpenTexelsStayAsTheyWereAlsoWhenTheyAreBlack)
{
    const Lumels lumels = grid({"aaA"});
    const Image map = filled(lumels, {glm::vec3(0.0f), {3.0f, 0.0f, 0.0f}, glm::vec3(0.0f)});
    EXPECT_EQ(map.at(0, 0)[0], 0.0f);
    EXPECT_EQ(map.at(1, 0)[0], 3.0f);
    EXPECT_EQ(map.at(2, 0)[0], 3.0f);
}

TEST(FillBuried, LightNeverComesFromAnotherChart)
{
    const Lumels lumels = grid({"bbB", "AAA"});
    const Image map = filled(lumels, 7.0f);
    EXPECT_EQ(rgb(map, 2, 0), glm::vec3(7.0f));
    for (int x = 0; x < 3; ++x)
        EXPECT_EQ(rgb(map, x, 1), glm::vec3(0.0f));
}

TEST(FillBuried, AnOpenBackKeepsItsLightOverABuriedFront)
{
    Lumels lumels = grid({"aA"});
    add_backs(lumels, 0);
    const Image map =
        filled(lumels, {glm::vec3(1.0f), glm::vec3(0.0f), glm::vec3(5.0f), glm::vec3(6.0f)});
    EXPECT_EQ(map.at(0, 0)[0], 5.0f);
    EXPECT_EQ(map.at(1, 0)[0], 6.0f);
}

TEST(FillBuried, AnOpenFrontStaysBlackOverABuriedBack)
{
    Lumels lumels = grid({"aa"});
    add_backs(lumels, kLumelBuried);
    const Image map =
        filled(lumels, {glm::vec3(3.0f), glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f)});
    EXPECT_EQ(map.at(0, 0)[0], 3.0f);
    EXPECT_EQ(map.at(1, 0)[0], 0.0f);
}

}  // namespace
}  // namespace lumel
