// Visible noise against the spectrum of white noise.

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "links/filter/visible_noise.h"

namespace lumel::test {
namespace {

constexpr int kSide = 256;
constexpr float kLight = 50.0f;  // [lx]

NoiseChart square()
{
    NoiseChart chart{.width = kSide, .height = kSide};
    for (std::uint32_t i = 0; i < kSide * kSide; ++i)
        chart.lumel.push_back(i);
    chart.is_blocked.assign(chart.lumel.size(), 0);
    return chart;
}

Mean exact()
{
    const std::size_t count = kSide * kSide;
    return {Estimates(count), std::vector<float>(count), std::vector<float>(count),
            std::vector<glm::vec2>(count, glm::vec2(0.0f)),
            std::vector<glm::vec3>(count, glm::vec3(0.0f))};
}

/// Variance that a difference of Gaussian means leaves of white noise of variance 1: the integral
/// of its square.
double left(double fine, double coarse)
{
    using std::numbers::pi;
    return 1.0 / (4.0 * pi * fine * fine) + 1.0 / (4.0 * pi * coarse * coarse) -
           1.0 / (pi * (fine * fine + coarse * coarse));
}

/// Bands that white noise of deviation kLight has beside light kLight.
void expect_white(const ChartNoise& noise)
{
    EXPECT_NEAR(noise.light, kLight, 1e-3);
    EXPECT_NEAR(noise.power_in(0) / left(1, 2), 1.0, 0.05);
    EXPECT_NEAR(noise.power_in(1) / left(2, 4), 1.0, 0.1);
    EXPECT_NEAR(noise.power_in(2) / left(4, 8), 1.0, 0.2);
    EXPECT_NEAR(noise.power_in(3) / left(8, 16), 1.0, 0.4);
}

const std::vector<float> kEven(kSide* kSide, kLight);

TEST(VisibleNoise, IsTheSpectrumOfWhiteNoise)
{
    std::mt19937 random(1);
    std::normal_distribution<float> white(0.0f, kLight * std::numbers::sqrt2_v<float> / 2.0f);
    Mean mean = exact();
    for (glm::vec2& apart : mean.apart)
        apart = {white(random), white(random)};
    expect_white(chart_noise(square(), kEven, {&mean}));
}

TEST(VisibleNoise, CountsWhatTheFilterBendsInAllEstimatesAlike)
{
    std::mt19937 random(2);
    std::normal_distribution<float> white(0.0f, kLight);
    Mean mean = exact();
    for (glm::vec3& bend : mean.bend)
        bend = glm::vec3(white(random));
    expect_white(chart_noise(square(), kEven, {&mean}));
    for (glm::vec3& bend : mean.bend)
        bend = {white(random), white(random), white(random)};
    EXPECT_LT(chart_noise(square(), kEven, {&mean}).power_in(0), 0.05 * left(1, 2));
}

TEST(VisibleNoise, LeavesOutRimsAndWhatIsNearGeometry)
{
    NoiseChart chart = square();
    Mean mean = exact();
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const bool is_rim = std::min({x, y, kSide - 1 - x, kSide - 1 - y}) < 3;
            const int from_post = std::abs(x - kSide / 2) + std::abs(y - kSide / 2);
            chart.is_blocked[chart.at(x, y)] = from_post == 0;
            if (is_rim || from_post <= 8)
                mean.apart[chart.at(x, y)].x = (x + y) % 2 == 0 ? kLight : -kLight;
        }
    const ChartNoise noise = chart_noise(chart, kEven, {&mean});
    EXPECT_EQ(noise.power_in(0), 0.0);
    EXPECT_EQ(noise.lumels.size() + noise.beside.size(), kEven.size() - 1) << "all but the post";
    chart.is_blocked.assign(chart.is_blocked.size(), 0);
    EXPECT_GT(chart_noise(chart, kEven, {&mean}).power_in(0), 0.0);
}

TEST(VisibleNoise, TheWorstChartIsTheOneBelowWhichMostChartsAre)
{
    const auto chart = [](std::size_t lumels, double light, double band) {
        return ChartNoise{
            std::vector<std::uint32_t>(lumels), {}, light, {{band * band, 0.0, 0.0, 0.0}}};
    };
    const VisibleNoise noise =
        visible_noise(in_order({chart(4, 1.0, 0.5), chart(800, 1.0, 0.01), chart(160, 1.0, 0.02),
                                chart(9000, 1e-6, 9.0), ChartNoise()}));
    EXPECT_NEAR(noise.worst_chart, 0.02, 1e-12);
    EXPECT_NEAR(noise.bands[0], std::sqrt((4 * 0.25 + 800 * 1e-4 + 160 * 4e-4) / 964), 1e-12);
    EXPECT_LT(visible_noise({}).worst_chart, 0.0);
    // A large ground does not hide rooms.
    EXPECT_NEAR(
        visible_noise(in_order({chart(10000, 1.0, 0.001), chart(400, 1.0, 0.03)})).worst_chart,
        0.03, 1e-12);
}

}  // namespace
}  // namespace lumel::test
