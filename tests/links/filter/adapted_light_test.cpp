// The light that an eye adapts to, in rooms where it is known.

#include <cmath>

#include <gtest/gtest.h>

#include "links/filter/adapted_light.h"

namespace lumel {
namespace {

constexpr int kSide = 24;

/// Square charts of kSide lumels, side by side.
Lumels charts(int count)
{
    Lumels lumels{.width = count * (kSide + 4), .height = kSide};
    for (int chart = 0; chart < count; ++chart)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                Lumel lumel{};
                lumel.chart = std::uint32_t(chart);
                lumel.texel = std::uint32_t(y * lumels.width + chart * (kSide + 4) + x);
                lumels.lumels.push_back(lumel);
            }
    return lumels;
}

constexpr std::size_t kOfChart = std::size_t(kSide * kSide);

TEST(AdaptedLight, OfAnEvenlyLitWallIsItsLight)
{
    for (const double one : adapted_light(charts(1), std::vector<double>(kOfChart, 7.0)))
        EXPECT_NEAR(one, 7.0, 1e-9);
}

TEST(AdaptedLight, OfADarkWallIsItsOwnBesideABrightOne)
{
    std::vector<double> light(2 * kOfChart, 10.0);
    std::fill(light.begin() + kOfChart, light.end(), 1.0);
    const std::vector<double> adapted = adapted_light(charts(2), light);
    EXPECT_NEAR(adapted.front(), 10.0, 1e-9);
    EXPECT_NEAR(adapted.back(), 1.0, 1e-9);
}

TEST(AdaptedLight, IsAtLeastTwoPercentOfTheMean)
{
    std::vector<double> light(2 * kOfChart, 10.0);
    std::fill(light.begin() + kOfChart, light.end(), 0.0);
    const std::vector<double> adapted = adapted_light(charts(2), light);
    // 2 % of the mean of all but the brightest hundredth, which is half lit.
    EXPECT_NEAR(adapted.back(), 0.02 * 5.0, 0.002);
}

TEST(AdaptedLight, DoesNotCountALumelAsItsOwnSurroundings)
{
    std::vector<double> light(kOfChart, 1.0);
    const std::size_t speck = kOfChart / 2 + kSide / 2;
    light[speck] = 500.0;
    const double mean = 1.0 + 499.0 / double(kOfChart);
    const std::vector<double> adapted = adapted_light(charts(1), light);
    EXPECT_NEAR(adapted[speck], mean, 1e-6);
    EXPECT_GT(adapted[speck + 1], 10.0 * mean);  // its neighbours are dazzled
}

TEST(AdaptedLight, OfBuriedLumelsIsNone)
{
    Lumels lumels = charts(1);
    std::vector<double> light(kOfChart, 1.0);
    lumels.lumels[0].flags |= kLumelBuried;
    light[0] = 1e6;
    const std::vector<double> adapted = adapted_light(lumels, light);
    EXPECT_EQ(adapted[0], 0.0);
    EXPECT_NEAR(adapted[1], 1.0, 1e-9);
}

}  // namespace
}  // namespace lumel
