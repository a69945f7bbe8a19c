#include "links/filter/pyramid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace lumel {
namespace {

constexpr int kSide = 96;
constexpr float kNoise = 0.2f;
/// Distance that rays go, in lumels: lights the middle of a large room.
constexpr float kFarAway = 100.0f;

using LightAt = std::function<float(int x, int y)>;

/// A flat square chart without obstacles.
FilterChart flat_chart()
{
    FilterChart chart{.width = kSide, .height = kSide};
    for (std::uint32_t t = 0; t < kSide * kSide; ++t)
        chart.lumel.push_back(t);
    chart.steps.assign(chart.lumel.size(), 0xF);
    chart.normal.assign(chart.lumel.size(), {0.0f, 0.0f, 1.0f});
    chart.nearness.assign(chart.lumel.size(), 1.0f / kFarAway);
    return chart;
}

/// Three solutions of that light, each with noise of its own.
Solutions solutions_of(const LightAt& light, float noise = kNoise, unsigned seed = 1)
{
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    Solutions found;
    for (Estimates& of : found)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                of.emplace_back(light(x, y) + noise * normal(random));
    return found;
}

std::vector<float> filtered(const FilterChart& chart, const Solutions& found,
                            const PyramidRule& rule = rule_of_indirect())
{
    std::vector<float> mean;
    const std::vector<FitLight<3>> filtered =
        filter_chart<3>(chart, {&found[0], &found[1], &found[2]}, rule).light;
    for (const FitLight<3>& light : filtered)
        mean.push_back((light[0] + light[3] + light[6]) / 3.0f);
    return mean;
}

/// Root mean square error.
double error_of(const FilterChart& chart, const std::vector<float>& mean, const LightAt& light)
{
    double squares = 0.0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            squares += std::pow(double(mean[chart.at(x, y)] - light(x, y)), 2.0);
    return std::sqrt(squares / double(mean.size()));
}

float even(int, int)
{
    return 1.0f;
}

float bowl(int x, int y)
{
    const float u = float(x) / kSide - 0.3f, v = float(y) / kSide - 0.6f;
    return 1.0f + u * u + 0.5f * u * v - 2.0f * v * v;
}

/// Left of x = 48 it is day.
float edge(int x, int)
{
    return x < 48 ? 4.0f : 1.0f;
}

TEST(Pyramid, NoiseOfEvenLightFallsToATenth)
{
    const FilterChart chart = flat_chart();
    EXPECT_LT(error_of(chart, filtered(chart, solutions_of(even)), even),
              0.1 * double(kNoise) / std::sqrt(3.0));
}

/// Beside a wall, light changes with the distance to it, and noise can pass for that.
TEST(Pyramid, NoiseBesideAWallFallsToAQuarter)
{
    FilterChart chart = flat_chart();
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            chart.nearness[chart.at(x, y)] = 1.0f / (float(y) + 0.5f);
    const auto corner = [](int, int y) { return 1.0f - 0.3f / (1.0f + 0.2f * float(y)); };
    const std::vector<float> mean = filtered(chart, solutions_of(corner));
    for (int y = 1; y < 4; ++y) {
        double squares = 0.0;
        for (int x = 0; x < kSide; ++x)
            squares += std::pow(double(mean[chart.at(x, y)] - corner(x, y)), 2.0) / double(kSide);
        EXPECT_LT(std::sqrt(squares), 0.25 * double(kNoise) / std::sqrt(3.0)) << y;
    }
}

TEST(Pyramid, LightWithoutNoiseIsLeftAsItIs)
{
    const auto wave = [](int x, int y) { return 2.0f + std::sin(0.7f * float(x) + float(y)); };
    const FilterChart chart = flat_chart();
    EXPECT_LT(error_of(chart, filtered(chart, solutions_of(bowl, 0.0f)), bowl), 1e-4);
    EXPECT_LT(error_of(chart, filtered(chart, solutions_of(wave, 0.0f), rule_of_direct()), wave),
              1e-4);
}

TEST(Pyramid, SlowChangesOfLightStay)
{
    const FilterChart chart = flat_chart();
    EXPECT_LT(error_of(chart, filtered(chart, solutions_of(bowl)), bowl),
              0.12 * double(kNoise) / std::sqrt(3.0));
}

TEST(Pyramid, EdgesOfDirectLightStay)
{
    const FilterChart chart = flat_chart();
    const std::vector<float> mean = filtered(chart, solutions_of(edge, 0.1f), rule_of_direct());
    for (int y = 0; y < kSide; ++y)
        for (const int x : {47, 48})
            EXPECT_NEAR(mean[chart.at(x, y)], edge(x, y), 0.3f);
}

TEST(Pyramid, ExactDirectLightBesideANoisyPenumbraStays)
{
    const FilterChart chart = flat_chart();
    Solutions found = solutions_of(edge, 1.0f);
    for (Estimates& of : found)
        for (int y = 0; y < kSide; ++y)
            for (int x = 48; x < kSide; ++x)
                of[chart.at(x, y)] = glm::vec3(edge(x, y));
    const std::vector<float> mean = filtered(chart, found, rule_of_direct());
    for (int x = 48; x < kSide; ++x) {
        double squares = 0.0;
        for (int y = 0; y < kSide; ++y)
            squares += std::pow(double(mean[chart.at(x, y)] - edge(x, y)), 2.0) / double(kSide);
        EXPECT_LT(std::sqrt(squares), x == 48 ? 0.5 : 0.04) << x;
    }
}

TEST(Pyramid, LumelsWhoseHalvesAgreeByChanceDoNotStandOut)
{
    const FilterChart chart = flat_chart();
    constexpr unsigned kCharts = 10;
    const double deviation = double(kNoise) / std::sqrt(2.0);  // of the mean of the halves
    int specks = 0;
    for (unsigned seed = 1; seed <= kCharts; ++seed) {
        const Solutions found = solutions_of(even, kNoise, seed);
        for (const FitLight<2>& light :
             filter_chart<2>(chart, {&found[0], &found[1]}, rule_of_direct()).light)
            specks += std::abs(double(light[0] + light[3]) / 2.0 - 1.0) > deviation ? 1 : 0;
    }
    EXPECT_LT(specks, int(kCharts) * kSide * kSide / 5000);
}

/// A dark gap between things, whose lumels have many rays, close to bright and noisy ones.
/// Of 32 rays of a lumel, sometimes one meets a patch of sun. A few lumels have it in all
/// solutions.
TEST(Pyramid, RaysThatMeetTheSunByChanceMakeNoSpecks)
{
    constexpr float kChance = 0.12f, kSun = 1.8f;
    FilterChart chart = flat_chart();
    chart.nearness.assign(chart.lumel.size(), 0.3f);
    double brightest = 0.0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        std::mt19937 random(seed);
        std::bernoulli_distribution meets_sun(kChance);
        Solutions found = solutions_of(even, kNoise, seed);
        for (Estimates& of : found)
            for (glm::vec3& light : of)
                light += meets_sun(random) ? kSun : 0.0f;
        const std::vector<float> mean = filtered(chart, found);
        brightest = std::max(brightest, double(*std::ranges::max_element(mean)));
    }
    EXPECT_LT(brightest, 4.0 / 3.0 * double(1.0f + kChance * kSun));
}

TEST(Pyramid, LightOfManyRaysBesideNoisyLumelsStays)
{
    const auto gap = [](int x, int) { return x < 48 ? 4.0f : x < 54 || x >= 58 ? 1.0f : 0.5f; };
    FilterChart chart = flat_chart();
    std::ranges::fill(chart.nearness, 0.5f);
    Solutions found = solutions_of(gap, 3.0f);
    const Solutions exact = solutions_of(gap, 0.001f);
    for (std::size_t k = 0; k < found.size(); ++k)
        for (int y = 0; y < kSide; ++y)
            for (int x = 48; x < kSide; ++x)
                found[k][chart.at(x, y)] = exact[k][chart.at(x, y)];
    const std::vector<float> mean = filtered(chart, found);
    for (int x = 53; x < 60; ++x) {
        double sum = 0.0;
        for (int y = 0; y < kSide; ++y)
            sum += double(mean[chart.at(x, y)]) / double(kSide);
        EXPECT_NEAR(sum, gap(x, 0), 0.1) << x;
    }
}

class Wall : public testing::TestWithParam<int> {};

// Within and between the cells of each level.
INSTANTIATE_TEST_SUITE_P(At, Wall, testing::Range(41, 49));

TEST_P(Wall, LetsNothingPass)
{
    const int wall = GetParam();
    // Noise so strong that the gains cannot tell the sides apart; the same on both.
    Solutions found = solutions_of(even, 10.0f);
    FilterChart chart = flat_chart();
    const std::vector<float> before = filtered(chart, found);
    for (int y = 0; y < kSide; ++y) {
        chart.steps[chart.at(wall - 1, y)] &= std::uint8_t(~0b0101u);
        chart.steps[chart.at(wall, y)] &= std::uint8_t(~0b1000u);
    }
    const std::vector<float> walled = filtered(chart, found);
    for (Estimates& of : found)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < wall; ++x)
                of[chart.at(x, y)] += 1000.0f;
    const std::vector<float> lit = filtered(chart, found);
    double passed = 0.0, changed = 0.0;
    for (int y = 0; y < kSide; ++y)
        for (int x = wall; x < kSide; ++x) {
            passed = std::max(passed, double(std::abs(lit[chart.at(x, y)])));
            changed += double(std::abs(before[chart.at(x, y)] - walled[chart.at(x, y)]));
        }
    EXPECT_LT(passed, 60.0);  // by noise alone, and not by 1000
    EXPECT_GT(changed, 0.0);
}

TEST(Pyramid, FacesThatTurnAwayDoNotMix)
{
    FilterChart chart = flat_chart();
    for (int y = 0; y < kSide; ++y)
        for (int x = 48; x < kSide; ++x)
            chart.normal[chart.at(x, y)] = {0.6f, 0.0f, 0.8f};
    const std::vector<float> mean = filtered(chart, solutions_of(edge, 0.0f));
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            EXPECT_NEAR(mean[chart.at(x, y)], edge(x, y), 1e-3f);
}

TEST(Pyramid, ALumelAloneKeepsItsLight)
{
    FilterChart chart = flat_chart();
    for (std::size_t t = 0; t < chart.lumel.size(); ++t)
        if (t != chart.at(20, 30))
            chart.lumel[t] = kNoLumel;
    const Solutions found = solutions_of(even);
    const std::size_t t = chart.at(20, 30);
    EXPECT_NEAR(filtered(chart, found)[t], (found[0][t].x + found[1][t].x + found[2][t].x) / 3.0f,
                1e-5f);
}

}  // namespace
}  // namespace lumel
