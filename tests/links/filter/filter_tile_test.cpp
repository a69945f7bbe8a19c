#include "links/filter/filter_tile.h"

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
            tile->nearest[t] = 100.0f;
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

struct Result {
    std::unique_ptr<FilteredTiles> tiles = std::make_unique<FilteredTiles>();

    float one(std::size_t bell, int x, int y, std::uint32_t solution = 0) const
    {
        const FilteredTile& tile = (*tiles)[bell][solution];
        const std::size_t t = std::size_t(y * kTile + x);
        return tile.one[0][t] / tile.weight[t];
    }
};

Result filter(const FilterTile& tile)
{
    Result result;
    filter_tile(tile, *result.tiles);
    return result;
}

/// Root of the mean square of what is left of noise around `light`.
double left_of_noise(const Result& result, std::size_t bell,
                     const std::function<float(int x, int y)>& light)
{
    double sum = 0.0;
    for (int y = 0; y < kTile; ++y)
        for (int x = 0; x < kTile; ++x)
            sum += std::pow(double(result.one(bell, x, y) - light(x, y)), 2.0);
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

TEST(FilterTile, TheMeanOfAlikeLumelsHasLessNoiseTheMoreTheyAre)
{
    const Result result = filter(*flat(even));
    // All weights 1: a bell of deviation s is worth 4πs² lumels.
    EXPECT_LT(left_of_noise(result, 0, even), 0.4 * double(kNoise));
    EXPECT_LT(left_of_noise(result, 1, even), 0.2 * double(kNoise));
}

TEST(FilterTile, TheWideBellIsNarrowNextToOtherThings)
{
    auto tile = flat(even);
    tile->nearest.fill(0.5f);
    const Result result = filter(*tile);
    for (int x = 0; x < kTile; ++x)
        EXPECT_EQ(result.one(1, x, 7), result.one(0, x, 7));
}

TEST(FilterTile, EdgesOfLightStay)
{
    const Result result = filter(*flat(edge));
    for (std::size_t bell = 0; bell < kBells; ++bell)
        for (int y = 0; y < kTile; ++y)
            for (const int x : {10, 11})
                EXPECT_NEAR(result.one(bell, x, y), edge(x, y), 3.5f * kNoise) << bell;
}

TEST(FilterTile, LightWithoutNoiseIsLeftAsItIs)
{
    const auto wave = [](int x, int y) { return 2.0f + std::sin(0.7f * float(x) + float(y)); };
    const Result result = filter(*flat(wave, 0.0f));
    for (std::size_t bell = 0; bell < kBells; ++bell)
        EXPECT_LT(left_of_noise(result, bell, wave), 1e-5);
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
    const Result through = filter(*tile);
    wall(*tile);
    const Result walled = filter(*tile);
    for (std::size_t bell = 0; bell < kBells; ++bell)
        for (int y = 0; y < kTile; ++y) {
            EXPECT_LT(through.one(bell, 10, y), 3.5f);
            for (int x = 0; x < kTile; ++x)
                EXPECT_NEAR(walled.one(bell, x, y), edge(x, y), 1e-5f) << bell << ' ' << x;
        }
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
    const Result result = filter(*tile);
    for (int x = 0; x < kTile; ++x)
        EXPECT_NEAR(result.one(1, x, 5), edge(x, 5), 1e-5f);
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
    const Result result = filter(*tile);
    for (int x = 0; x < kTile; ++x)
        EXPECT_NEAR(result.one(1, x, 5), edge(x, 5), 1e-5f);
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
