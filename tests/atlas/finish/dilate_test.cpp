#include <gtest/gtest.h>

#include "atlas/finish/finish.h"
#include "grid_lumels.h"

namespace lumel {
namespace {

// A few charts of different light, far apart in a large map.
Image islands()
{
    Image map(97, 64, 4);
    const auto fill = [&](int x0, int y0, int side, float light) {
        for (int y = y0; y < y0 + side; ++y)
            for (int x = x0; x < x0 + side; ++x) {
                float* texel = map.at(x, y);
                texel[0] = texel[1] = texel[2] = light;
                texel[3] = 0.5f;
            }
    };
    fill(3, 5, 6, 1.0f);
    fill(60, 40, 9, 2.0f);
    fill(90, 2, 1, 4.0f);
    return map;
}

TEST(Dilate, NoTexelOfTheMapStaysBlack)
{
    Image map = islands();
    dilate(map);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            EXPECT_GE(map.at(x, y)[0], 1.0f);
}

TEST(Dilate, CoveredTexelsAndAlphaStayExactly)
{
    const Image before = islands();
    Image map = before;
    dilate(map);
    for (std::size_t i = 0; i < map.values.size(); i += 4) {
        EXPECT_EQ(map.values[i + 3], before.values[i + 3]);
        if (before.values[i + 3] > 0.0f) {
            EXPECT_EQ(map.values[i], before.values[i]);
        }
    }
}

TEST(Dilate, AGutterTakesTheLightOfItsOwnChart)
{
    Image map = islands();
    dilate(map);
    for (int distance = 1; distance <= 8; ++distance) {
        EXPECT_FLOAT_EQ(map.at(8 + distance, 8)[0], 1.0f);
        EXPECT_FLOAT_EQ(map.at(60 - distance, 44)[0], 2.0f);
    }
}

TEST(Dilate, TheMipmapOfOneTexelSeesOnlyLight)
{
    Image map = islands();
    dilate(map);
    double sum = 0.0;
    for (std::size_t i = 0; i < map.values.size(); i += 4)
        sum += map.values[i];
    EXPECT_GE(sum / double(map.width * map.height), 1.0);
}

TEST(Dilate, AMapWithoutCoverageStaysBlack)
{
    Image map(8, 8, 4);
    dilate(map);
    for (const float value : map.values)
        EXPECT_EQ(value, 0.0f);
}

}  // namespace
}  // namespace lumel
