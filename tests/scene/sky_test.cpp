// Light from all around: where the image's texels lie, and directions drawn from it.

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "base/core/luminance.h"
#include "scene/values/sky.h"

using namespace lumel;

namespace {

/// Smooth, with a sun of four texels and a black row.
Sky uneven_sky()
{
    Sky sky{.width = 32, .height = 16};
    for (int row = 0; row < sky.height; ++row)
        for (int column = 0; column < sky.width; ++column) {
            const float bright = row == 9 ? 0.0f : float(1 + row) * float(1 + (column * 7) % 32);
            sky.radiance.emplace_back(bright, 0.5f * bright, 3.0f);
        }
    for (int column = 29; column < 32; ++column)
        sky.radiance[std::size_t(3 * 32 + column)] = {9e4f, 8e4f, 7e4f};
    for (int column = 0; column < 32; ++column)
        sky.radiance[std::size_t(9 * 32 + column)] = glm::vec3(0.0f);
    return sky;
}

/// A sky of numbered texels.
Sky numbered_sky(int width, int height)
{
    Sky sky{.width = width, .height = height};
    for (int i = 0; i < width * height; ++i)
        sky.radiance.emplace_back(float(i));
    return sky;
}

/// Calls visit(direction, solid angle) for a fine grid over each texel.
template <typename Visit>
void for_sphere(const Sky& sky, const Visit& visit)
{
    constexpr int kFine = 32;
    const int columns = sky.width * kFine;
    for (int row = 0; row < sky.height * kFine; ++row) {
        const double step = std::numbers::pi / (sky.height * kFine), theta = (row + 0.5) * step;
        const double angle =
            (std::cos(row * step) - std::cos((row + 1) * step)) * 2.0 * std::numbers::pi / columns;
        for (int column = 0; column < columns; ++column) {
            const double phi = (column + 0.5) * 2.0 * std::numbers::pi / columns,
                         sine = std::sin(theta);
            visit(glm::vec3(sine * std::cos(phi), std::cos(theta), sine * std::sin(phi)), angle);
        }
    }
}

}  // namespace

TEST(Sky, TheImageRunsFromMinusXByMinusZToItsCentreAtPlusX)
{
    const Sky sky = numbered_sky(4, 3);  // one row around the horizon, quarters of it in columns
    const auto texel = [&](const glm::vec3& d) { return sky_radiance(sky, glm::normalize(d)).x; };
    const float e = 0.1f;
    EXPECT_EQ(texel({-1, 0, -e}), 4);  // the left edge
    EXPECT_EQ(texel({-e, 0, -1}), 4);
    EXPECT_EQ(texel({e, 0, -1}), 5);
    EXPECT_EQ(texel({1, 0, -e}), 5);
    EXPECT_EQ(texel({1, 0, e}), 6);  // right of the centre
    EXPECT_EQ(texel({-e, 0, 1}), 7);
    EXPECT_EQ(texel({-1, 0, e}), 7);  // the right edge
    EXPECT_LT(texel({e, 1, e}), 4);   // the zenith is the top row
    EXPECT_GE(texel({e, -1, e}), 8);
    for (const float y : {-1.0f, 1.0f})
        EXPECT_NO_FATAL_FAILURE(sky_radiance(sky, {0, y, 0}));
    EXPECT_EQ(sky_radiance(Sky{}, {0, 1, 0}), glm::vec3(0.0f));
}

TEST(Sky, SolidAnglesOfTheTexelsMakeASphere)
{
    const Sky sky = numbered_sky(20, 10);
    double sum = 0.0;
    for (int row = 0; row < sky.height; ++row)
        sum += double(sky_texel_angle(sky, row)) * sky.width;
    EXPECT_NEAR(sum, 4.0 * std::numbers::pi, 1e-5);
}

TEST(Sky, TheDensityOfDirectionsIntegratesToOne)
{
    const Sky sky = uneven_sky();
    const SkySampler sampler(sky);
    double sum = 0.0;
    for_sphere(sky, [&](const glm::vec3& d, double angle) { sum += sampler.density(d) * angle; });
    EXPECT_NEAR(sum, 1.0, 1e-5);
}

TEST(Sky, DirectionsAreDrawnWithTheDensityAndRadianceThatAreSaid)
{
    const Sky sky = uneven_sky();
    const SkySampler sampler(sky);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform;
    constexpr int kDraws = 100000;
    int strays = 0;  // rounding may carry a direction over the edge of its texel
    for (int i = 0; i < kDraws; ++i) {
        const SkySample sample = sampler.sample({uniform(random), uniform(random)});
        ASSERT_GT(sample.density, 0.0f);
        ASSERT_NEAR(glm::length(sample.direction), 1.0f, 1e-5f);
        strays += sampler.density(sample.direction) != sample.density ||
                  sky_radiance(sky, sample.direction) != sample.radiance;
    }
    EXPECT_LT(strays, kDraws / 10000);
    for (const float x : {0.0f, 1.0f})
        for (const float y : {0.0f, 1.0f})
            EXPECT_GT(sampler.sample({x, y}).density, 0.0f);
}

TEST(Sky, DrawnDirectionsEstimateTheIrradianceOfAPlane)
{
    const Sky sky = uneven_sky();
    const SkySampler sampler(sky);
    const glm::vec3 normal = glm::normalize(glm::vec3(1, 2, -0.5f));
    glm::dvec3 exact(0.0);
    for_sphere(sky, [&](const glm::vec3& d, double angle) {
        exact +=
            glm::dvec3(sky_radiance(sky, d)) * double(std::max(0.0f, glm::dot(d, normal))) * angle;
    });
    // A grid of places, so that the estimate hardly scatters.
    constexpr int kSide = 700;
    glm::dvec3 mean(0.0);
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::vec2 at((float(i % kSide) + 0.5f) / kSide, (float(i / kSide) + 0.5f) / kSide);
        const SkySample sample = sampler.sample(at);
        mean += glm::dvec3(sample.radiance) *
                double(std::max(0.0f, glm::dot(sample.direction, normal)) / sample.density) /
                double(kSide * kSide);
    }
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean[c], exact[c], 2e-3 * exact[c]);
}

TEST(Sky, BlackSkiesCanNotBeDrawnFrom)
{
    const Sky black{.width = 2, .height = 1, .radiance = {glm::vec3(0.0f), glm::vec3(0.0f)}};
    EXPECT_TRUE(SkySampler(black).empty());
    EXPECT_TRUE(SkySampler(Sky{}).empty());
    EXPECT_EQ(SkySampler(black).density({0, 1, 0}), 0.0f);
}
