#include "truth/metrics.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/core/error.h"

namespace lumel {
namespace {

/// A covered map with one grey value per texel.
Image grey(int width, int height, const std::vector<float>& values)
{
    Image image(width, height, 4);
    for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            image.values[i * 4 + c] = c < 3 ? values[i] : 1.0f;
    return image;
}

TEST(Metrics, AMapHasNoErrorAgainstItself)
{
    const Image map = grey(2, 2, {1, 2, 3, 4});
    const MapError error = compare_maps(map, map);
    EXPECT_EQ(error.relative_rmse, 0.0);
    EXPECT_EQ(error.rel_mse, 0.0);
    EXPECT_EQ(error.bias, 0.0);
    EXPECT_EQ(error.p95, 0.0);
    EXPECT_EQ(error.max, 0.0);
    EXPECT_EQ(error.texels, 4u);
}

TEST(Metrics, FollowTheirDefinitions)
{
    // d = (1, -1, 0, 2), mean reference 7/4.
    const MapError error = compare_maps(grey(2, 2, {2, 1, 2, 4}), grey(2, 2, {1, 2, 2, 2}));
    const double mean = 7.0 / 4.0;
    EXPECT_NEAR(error.relative_rmse, std::sqrt(6.0 / 4.0) / mean, 1e-12);
    EXPECT_NEAR(error.bias, (2.0 / 4.0) / mean, 1e-12);
    EXPECT_NEAR(error.max, 2.0 / mean, 1e-12);
    EXPECT_NEAR(error.p95, 2.0 / mean, 1e-12);
    const double floor = std::pow(0.01 * mean, 2);
    EXPECT_NEAR(error.rel_mse, (1 / (1 + floor) + 1 / (4 + floor) + 0 + 4 / (4 + floor)) / 4.0,
                1e-12);
}

TEST(Metrics, The95thPercentileIgnoresTheWorstTwentieth)
{
    std::vector<float> off(1000, 1.0f);
    for (std::size_t i = 0; i < 40; ++i)
        off[i] = 11.0f;
    const MapError error =
        compare_maps(grey(100, 10, off), grey(100, 10, std::vector<float>(1000, 1.0f)));
    EXPECT_EQ(error.p95, 0.0);
    EXPECT_NEAR(error.max, 10.0, 1e-9);
}

TEST(Metrics, OnlyTexelsCoveredInBothCount)
{
    Image map = grey(3, 1, {1, 50, 1}), reference = grey(3, 1, {1, 1, 70});
    map.at(1, 0)[3] = 0.0f;
    reference.at(2, 0)[3] = 0.0f;
    const MapError error = compare_maps(map, reference);
    EXPECT_EQ(error.texels, 1u);
    EXPECT_EQ(error.relative_rmse, 0.0);
}

TEST(Metrics, ANumberThatIsNoneIsInfinitelyWrong)
{
    const MapError error =
        compare_maps(grey(2, 1, {1, std::numeric_limits<float>::quiet_NaN()}), grey(2, 1, {1, 1}));
    EXPECT_TRUE(std::isinf(error.relative_rmse));
    EXPECT_TRUE(std::isinf(error.max));
}

TEST(Metrics, RefuseMapsThatCannotBeCompared)
{
    EXPECT_THROW(compare_maps(grey(2, 1, {1, 1}), grey(1, 2, {1, 1})), Error);
    EXPECT_THROW(compare_maps(Image(2, 2, 4), Image(2, 2, 4)), Error);
    EXPECT_THROW(heat_map(grey(2, 1, {1, 1}), grey(1, 2, {1, 1})), Error);
}

TEST(Metrics, HeatGrowsWithErrorAndSparesWhatIsNotCovered)
{
    constexpr int kSteps = 64;
    std::vector<float> values;
    for (int i = 0; i < kSteps; ++i)
        values.push_back(1.0f + 0.1f * float(i) / float(kSteps - 1));
    Image map = grey(kSteps, 1, values);
    Image one = grey(kSteps, 1, std::vector<float>(kSteps, 1.0f));
    Image heat = heat_map(map, one);
    float before = -1.0f;
    for (int i = 0; i < kSteps; ++i) {
        const float* color = heat.at(i, 0);
        const float lightness = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
        EXPECT_GT(lightness, before) << "step " << i;
        EXPECT_EQ(color[3], 1.0f);
        before = lightness;
    }
    EXPECT_EQ(heat.at(0, 0)[0], 0.0f);
    EXPECT_NEAR(before, 1.0f, 1e-4f);

    map.at(5, 0)[3] = 0.0f;
    EXPECT_EQ(heat_map(map, one).at(5, 0)[3], 0.0f);
}

}  // namespace
}  // namespace lumel
