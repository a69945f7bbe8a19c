#include <gtest/gtest.h>

#include "atlas/finish/finish.h"
#include "grid_lumels.h"

namespace lumel {
namespace {

using test::grid;
using test::rgb;

Image lit_map(const Lumels& lumels, float open_light)
{
    std::vector<glm::vec3> values;
    for (const Lumel& lumel : lumels.lumels)
        values.emplace_back(lumel.flags & kLumelBuried ? 0.0f : open_light);
    return to_map(lumels, values);
}

TEST(FillBuried, BuriedTexelsTakeTheLightAroundThem)
{
    const Lumels lumels = grid({"aaaaa", "aAAAa", "aAAAa", "aAAAa", "aaaaa"});
    Image map = lit_map(lumels, 7.0f);
    fill_buried(map, lumels);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x)
            EXPECT_EQ(rgb(map, x, y), glm::vec3(7.0f));
}

TEST(FillBuried, OpenTexelsStayAsTheyWereAlsoWhenTheyAreBlack)
{
    const Lumels lumels = grid({"aaA"});
    Image map = lit_map(lumels, 0.0f);
    map.at(1, 0)[0] = 3.0f;
    fill_buried(map, lumels);
    EXPECT_EQ(map.at(0, 0)[0], 0.0f);
    EXPECT_EQ(map.at(1, 0)[0], 3.0f);
    EXPECT_EQ(map.at(2, 0)[0], 3.0f);
}

TEST(FillBuried, LightNeverComesFromAnotherChart)
{
    const Lumels lumels = grid({"bbB", "AAA"});
    Image map = lit_map(lumels, 7.0f);
    fill_buried(map, lumels);
    EXPECT_EQ(rgb(map, 2, 0), glm::vec3(7.0f));
    for (int x = 0; x < 3; ++x)
        EXPECT_EQ(rgb(map, x, 1), glm::vec3(0.0f));
}

TEST(FillBuried, AnOpenBackKeepsItsLightOverABuriedFront)
{
    Lumels lumels = grid({"aA"});
    for (Lumel back : std::vector<Lumel>(lumels.lumels)) {
        back.flags = kLumelBack;
        lumels.lumels.push_back(back);
    }
    std::vector<glm::vec3> values;
    for (const float value : {1.0f, 0.0f, 5.0f, 6.0f})
        values.emplace_back(value);
    Image map = to_map(lumels, values);
    fill_buried(map, lumels);
    EXPECT_EQ(map.at(0, 0)[0], 5.0f);
    EXPECT_EQ(map.at(1, 0)[0], 6.0f);
}

}  // namespace
}  // namespace lumel
