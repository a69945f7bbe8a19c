// Light of rare rays, shared among the lumels around.

#include "links/filter/outliers.h"

#include <array>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "links/filter/pyramid.h"

namespace lumel {
namespace {

constexpr int kSide = 96;
constexpr std::size_t kMiddle = std::size_t(kSide / 2) * kSide + kSide / 2;
constexpr float kLight = 10.0f;
using Light = std::vector<FitLight<kSolutions>>;

/// A flat chart with a wall across it, at a third of its width.
FilterChart chart_with_a_wall()
{
    FilterChart chart{.width = kSide, .height = kSide};
    for (std::uint32_t t = 0; t < kSide * kSide; ++t)
        chart.lumel.push_back(t);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            unsigned steps = 0;
            for (unsigned s = 0; s < kSteps.size(); ++s) {
                const int nx = x + kSteps[s].x, ny = y + kSteps[s].y;
                if (chart.contains(nx, ny) && (x < kSide / 3) == (nx < kSide / 3))
                    steps |= 1u << s;
            }
            chart.steps.push_back(std::uint8_t(steps));
        }
    chart.normal.assign(chart.lumel.size(), {0.0f, 0.0f, 1.0f});
    chart.nearness.assign(chart.lumel.size(), 0.01f);
    return chart;
}

/// Even light with some noise, 0 beyond the wall.
Light even_light()
{
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    Light light(kSide * kSide, FitLight<kSolutions>{});
    for (std::size_t t = 0; t < light.size(); ++t)
        if (int(t) % kSide >= kSide / 3)
            for (float& channel : light[t])
                channel = kLight * (1.0f + 0.3f * normal(random));
    return light;
}

double sum_of(const Light& light, std::size_t channel)
{
    return std::accumulate(light.begin(), light.end(), 0.0,
                           [&](double sum, const auto& one) { return sum + double(one[channel]); });
}

void add_outlier(Light& light, std::size_t texel, std::size_t solution, float times)
{
    for (std::size_t c = 0; c < 3; ++c)
        light[texel][3 * solution + c] += times * kLight;
}

TEST(Outliers, AreNotFoundInNoiseAlone)
{
    EXPECT_TRUE(find_outliers<kSolutions>(chart_with_a_wall(), even_light()).all.empty());
}

TEST(Outliers, KeepTheirLightButLeaveNoStain)
{
    const FilterChart chart = chart_with_a_wall();
    Light light = even_light();
    add_outlier(light, kMiddle, 1, 160.0f);
    const Light before = light;
    const Outliers outliers = find_outliers<kSolutions>(chart, light);
    ASSERT_EQ(outliers.all.size(), 1u);
    spread_outliers<kSolutions>(chart, outliers, light);
    for (std::size_t c = 0; c < 3 * kSolutions; ++c)
        EXPECT_NEAR(sum_of(light, c), sum_of(before, c), 1e-4 * sum_of(before, c)) << c;
    for (std::size_t t = 0; t < light.size(); ++t)
        for (std::size_t c = 3; c < 6; ++c) {
            if (t != kMiddle) {  // 2 % of the mean of three solutions
                EXPECT_LT(light[t][c], before[t][c] + 0.15f * kLight);
            }
            if (int(t) % kSide < kSide / 3) {
                EXPECT_EQ(light[t][c], 0.0f) << "beyond the wall";
            }
        }
    EXPECT_LT(light[kMiddle][3], 3.0f * kLight);
}

/// All rays near a small source meet it now and then.
TEST(Outliers, AreNotWhatNeighboursHaveToo)
{
    Light light = even_light();
    add_outlier(light, kMiddle, 1, 30.0f);
    add_outlier(light, kMiddle + kSide, 2, 20.0f);
    EXPECT_TRUE(find_outliers<kSolutions>(chart_with_a_wall(), light).all.empty());
}

TEST(Outliers, AreSharedAlikeInPartsOfTheLight)
{
    const FilterChart chart = chart_with_a_wall();
    Light light = even_light();
    add_outlier(light, kMiddle, 1, 160.0f);
    const Outliers outliers = find_outliers<kSolutions>(chart, light);
    // Of the mean, a third and the rest.
    std::vector<FitLight<8>> parts(light.size(), FitLight<8>{});
    for (std::size_t t = 0; t < light.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const float mean = (light[t][c] + light[t][3 + c] + light[t][6 + c]) / 3.0f;
            parts[t][c] = mean / 3.0f;
            parts[t][3 + c] = mean - parts[t][c];
        }
    spread_outliers<kSolutions>(chart, outliers, light);
    spread_parts<8>(chart, outliers, parts);
    for (std::size_t t = 0; t < light.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const float mean = (light[t][c] + light[t][3 + c] + light[t][6 + c]) / 3.0f;
            EXPECT_NEAR(parts[t][c] + parts[t][3 + c], mean, 1e-4f * kLight);
        }
}

}  // namespace
}  // namespace lumel
