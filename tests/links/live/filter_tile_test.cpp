#include "links/live/filter_tile.h"

#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "atlas/packing/atlas.h"

namespace lumel {
namespace {

constexpr float kNoise = 0.2f;

/// A flat square of lumels of one metre whose solutions are `light` with noise of their own.
std::unique_ptr<FilterTile> flat(const std::function<float(int x, int y)>& light,
                                 float noise = kNoise)
{
    auto tile = std::make_unique<FilterTile>();
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (int y = -kHalo; y < kTile + kHalo; ++y)
        for (int x = -kHalo; x < kTile + kHalo; ++x) {
            const std::size_t t = wide_at(x, y);
            tile->lumel[t] = std::uint32_t(t);
            tile->chart[t] = 0;
            tile->steps[t] = 0xF;
            tile->size[t] = 1.0f;
            for (std::size_t c = 0; c < 3; ++c) {
                tile->centre[c][t] = c == 0 ? float(x) : c == 1 ? float(y) : 0.0f;
                tile->normal[c][t] = c == 2 ? 1.0f : 0.0f;
                for (auto& of : tile->light)
                    of[c][t] = light(x, y) + noise * normal(random);
            }
            for (auto& variance : tile->variance)
                variance[t] = 3.0f * noise * noise;
        }
    return tile;
}

/// First channel of a solution, averaged by the weights of another.
class Result {
public:
    explicit Result(const FilterTile& tile) : tile_(tile) { weigh_tile(tile, 0, *weights_); }

    float at(int x, int y) const
    {
        constexpr std::size_t kFiltered = 1;
        const std::size_t t = wide_at(x, y), inner = std::size_t(y * kTile + x);
        float sum = tile_.light[kFiltered][0][t], of_weights = 1.0f;
        for (std::size_t n = 0; n < kNearWays; ++n) {
            const float weight = weights_->weight[n][inner];
            const Offset to = weights_->to[n];
            sum += weight * tile_.light[kFiltered][0][wide_at(x + to.x, y + to.y)];
            of_weights += weight;
        }
        return sum / of_weights;
    }

private:
    const FilterTile& tile_;
    std::unique_ptr<NearWeights> weights_ = std::make_unique<NearWeights>();
};

/// Root of the mean square of what is left of noise around `light`.
double left_of_noise(const Result& result, const std::function<float(int x, int y)>& light)
{
    double sum = 0.0;
    for (int y = 0; y < kTile; ++y)
        for (int x = 0; x < kTile; ++x)
            sum += std::pow(double(result.at(x, y) - light(x, y)), 2.0);
    return std::sqrt(sum / (kTile * kTile));
}

float even(int, int)
{
    return 1.0f;
}

/// Left of x = 11 it is day.
float edge(int x, int)
{
    return x < 11 ? 4.0f : 1.0f;
}

TEST(FilterTile, TheMeanOfAlikeLumelsHasLessNoise)
{
    const auto tile = flat(even);
    EXPECT_LT(left_of_noise(Result(*tile), even), 0.4 * double(kNoise));
}

TEST(FilterTile, EdgesOfLightStay)
{
    const auto tile = flat(edge);
    const Result result(*tile);
    for (int y = 0; y < kTile; ++y)
        for (const int x : {10, 11})
            EXPECT_NEAR(result.at(x, y), edge(x, y), 3.5f * kNoise);
}

TEST(FilterTile, LightWithoutNoiseIsLeftAsItIs)
{
    const auto wave = [](int x, int y) { return 2.0f + std::sin(0.7f * float(x) + float(y)); };
    const auto tile = flat(wave, 0.0f);
    EXPECT_LT(left_of_noise(Result(*tile), wave), 1e-5);
}

/// Forbids all steps between x = 10 and x = 11.
void wall(FilterTile& tile)
{
    for (int y = -kHalo; y < kTile + kHalo; ++y) {
        tile.steps[wide_at(10, y)] &= std::uint8_t(~0b0101u);
        tile.steps[wide_at(11, y)] &= std::uint8_t(~0b1000u);
    }
}

TEST(FilterTile, NothingPassesAWall)
{
    // Noise so strong that the filter cannot tell the sides apart.
    auto tile = flat(edge, 10.0f);
    for (auto& of : tile->light)
        for (auto& channel : of)
            for (int y = -kHalo; y < kTile + kHalo; ++y)
                for (int x = -kHalo; x < kTile + kHalo; ++x)
                    channel[wide_at(x, y)] = edge(x, y);
    const Result through(*tile);
    for (int y = 0; y < kTile; ++y)
        EXPECT_LT(through.at(10, y), 3.5f);
    wall(*tile);
    const Result walled(*tile);
    for (int y = 0; y < kTile; ++y)
        for (int x = 0; x < kTile; ++x)
            EXPECT_NEAR(walled.at(x, y), edge(x, y), 1e-5f) << x;
}

TEST(FilterTile, ChartsThatTouchInTheAtlasDoNotMix)
{
    auto tile = flat(edge, 0.0f);
    for (auto& variance : tile->variance)
        variance.fill(300.0f);
    for (int y = -kHalo; y < kTile + kHalo; ++y)
        for (int x = 11; x < kTile + kHalo; ++x)
            tile->chart[wide_at(x, y)] = 1;
    wall(*tile);
    const Result result(*tile);
    for (int x = 0; x < kTile; ++x)
        EXPECT_NEAR(result.at(x, 5), edge(x, 5), 1e-5f);
}

TEST(FilterTile, FacesThatTurnAwayDoNotMix)
{
    auto tile = flat(edge, 0.0f);
    for (auto& variance : tile->variance)
        variance.fill(300.0f);
    for (int y = -kHalo; y < kTile + kHalo; ++y)
        for (int x = 11; x < kTile + kHalo; ++x) {
            tile->normal[0][wide_at(x, y)] = 0.6f;
            tile->normal[2][wide_at(x, y)] = 0.8f;
        }
    const Result result(*tile);
    for (int x = 0; x < kTile; ++x)
        EXPECT_NEAR(result.at(x, 5), edge(x, 5), 1e-5f);
}

TEST(FilterTile, VarianceIsThatOfEachFollower)
{
    const auto tile = flat(even);
    Inner variance;
    find_variance(*tile, 1, variance);
    double sum = 0.0;
    for (const float v : variance)
        sum += double(v);
    EXPECT_NEAR(sum / double(variance.size()), 3.0 * double(kNoise * kNoise), 0.01);
}

}  // namespace
}  // namespace lumel
