// The reference's reflectance model: its energy, its symmetry, and its sampling.

#include "truth/brdf.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "../support/quadrature.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

using support::direction_of;
using support::over_hemisphere;
using support::value_of;

constexpr glm::vec3 kUp(0.0f, 0.0f, 1.0f);
constexpr float kExponents[] = {1.0f, 3.0f, 10.0f, 100.0f, 1000.0f};
constexpr float kCosines[] = {0.05f, 0.5f, 0.9f, 1.0f};

Brdf plastic(float shininess, float cos_toward)
{
    return {{glm::vec3(0.3f), glm::vec3(0.6f), shininess}, kUp, direction_of(cos_toward, 0.7)};
}

/// A random direction above the surface.
glm::vec3 any_direction(const PathSamples& samples, std::uint32_t pair)
{
    const glm::vec2 at = samples.random(pair);
    return direction_of(at.x, 2.0 * std::numbers::pi * double(at.y));
}

TEST(Brdf, IsHighestInTheMirrorDirectionAndDiffuseAcrossIt)
{
    constexpr double kCosine = 0.6, kAngle = 0.7;
    for (const float shininess : kExponents) {
        const Brdf brdf({glm::vec3(0.3f), glm::vec3(0.6f), shininess}, kUp,
                        direction_of(kCosine, kAngle));
        const double diffuse = 0.3 / std::numbers::pi;
        const double peak = 0.6 * (shininess + 1.0) / (2.0 * std::numbers::pi) / kCosine;
        const glm::vec3 mirror = direction_of(kCosine, kAngle + std::numbers::pi);
        EXPECT_NEAR(value_of(brdf, mirror).x, diffuse + peak, 1e-4 * peak);
        const glm::vec3 across = direction_of(0.8, kAngle);
        EXPECT_NEAR(glm::dot(across, mirror), 0.0f, 1e-6f);
        EXPECT_NEAR(value_of(brdf, across).x, diffuse, 1e-5);
    }
}

TEST(Brdf, LooksTheSameBothWays)
{
    for (const float shininess : kExponents)
        for (std::uint32_t i = 0; i < 1000; ++i) {
            const Reflectance look{{0.1f, 0.2f, 0.3f}, {0.6f, 0.0f, 0.1f}, shininess};
            const glm::vec3 a = any_direction({1, i}, 0), b = any_direction({1, i}, 1);
            const glm::vec3 there = value_of(Brdf(look, kUp, a), b);
            const glm::vec3 back = value_of(Brdf(look, kUp, b), a);
            // The mirror direction's rounding counts n times.
            EXPECT_LE(glm::length(there - back), 1e-6f * shininess * glm::length(there));
        }
}

TEST(Brdf, ReflectsNoMoreThanArrivesFromAnyDirection)
{
    for (const float shininess : kExponents)
        for (const float cosine : kCosines) {
            const double albedo = support::albedo_of(plastic(shininess, cosine));
            EXPECT_GE(albedo, 0.3);
            EXPECT_LE(albedo, 0.9 + 1e-4) << "n " << shininess << ", cos " << cosine;
        }
}

TEST(Brdf, OfWhiteMatteIsOneOverPi)
{
    const Brdf matte(kUp);
    EXPECT_EQ(matte.reflectance(), glm::vec3(1.0f));
    EXPECT_EQ(matte.respond(direction_of(0.3, 2.0)).shape, glm::vec3(1.0f));
    EXPECT_NEAR(support::albedo_of(matte), 1.0, 1e-5);
}

TEST(Brdf, ItsDensityIntegratesToAtMostOne)
{
    for (const float shininess : kExponents)
        for (const float cosine : kCosines) {
            const Brdf brdf = plastic(shininess, cosine);
            const double total = over_hemisphere(
                [&](const glm::vec3& incoming) { return brdf.respond(incoming).density; });
            EXPECT_LE(total, 1.001);
            // A third of the samples is diffuse and never lost.
            EXPECT_GE(total, 0.333);
        }
}

TEST(Brdf, SamplesAverageToItsAlbedo)
{
    constexpr std::uint32_t kCount = 1 << 16;
    for (const float shininess : kExponents)
        for (const float cosine : kCosines) {
            const Brdf brdf = plastic(shininess, cosine);
            double sum = 0.0;
            for (std::uint32_t i = 0; i < kCount; ++i) {
                const glm::vec3 incoming = brdf.sample(PathSamples(1, i).stratified(0));
                EXPECT_NEAR(glm::length(incoming), 1.0f, 1e-5f);
                if (incoming.z > 0.0f)
                    sum += double(value_of(brdf, incoming).x * incoming.z /
                                  brdf.respond(incoming).density);
            }
            const double truth = support::albedo_of(brdf);
            EXPECT_NEAR(sum / kCount, truth, 0.003 * truth)
                << "n " << shininess << ", cos " << cosine;
        }
}

constexpr std::size_t kRings = 12, kSectors = 12;

/// Number of the bin that a direction above the surface falls into.
std::size_t bin_of(const glm::vec3& direction)
{
    const double turn = std::atan2(direction.y, direction.x) / (2.0 * std::numbers::pi);
    const auto ring = std::size_t(double(direction.z) * kRings);
    const auto sector = std::size_t((turn - std::floor(turn)) * kSectors);
    return std::min(ring, kRings - 1) * kSectors + std::min(sector, kSectors - 1);
}

TEST(Brdf, SamplesFollowItsDensity)
{
    constexpr std::uint32_t kCount = 1 << 17;
    for (const float shininess : {1.0f, 10.0f, 100.0f})
        for (const float cosine : {0.2f, 0.8f}) {
            const Brdf brdf = plastic(shininess, cosine);
            std::vector<double> expected(kRings * kSectors), drawn(kRings * kSectors);
            support::for_hemisphere([&](const glm::vec3& incoming, double solid_angle) {
                expected[bin_of(incoming)] +=
                    kCount * solid_angle * double(brdf.respond(incoming).density);
            });
            for (std::uint32_t i = 0; i < kCount; ++i)
                if (const glm::vec3 direction = brdf.sample(PathSamples(2, i).random(0));
                    direction.z > 0.0f)
                    drawn[bin_of(direction)] += 1.0;

            double chi_squared = 0.0, degrees = 0.0;
            for (std::size_t bin = 0; bin < drawn.size(); ++bin) {
                if (expected[bin] < 5.0)
                    continue;
                const double difference = drawn[bin] - expected[bin];
                chi_squared += difference * difference / expected[bin];
                degrees += 1.0;
            }
            // Its deviation is √(2 degrees).
            EXPECT_LT(chi_squared, degrees + 5.0 * std::sqrt(2.0 * degrees))
                << "n " << shininess << ", cos " << cosine;
        }
}

TEST(Brdf, IsANumberFromEveryDirection)
{
    for (const float shininess : kExponents)
        for (std::uint32_t i = 0; i < 10000; ++i) {
            const PathSamples samples(3, i);
            // Flat ones too, and looked at from behind, as interpolated normals make possible.
            glm::vec3 toward = any_direction(samples, 0), incoming = any_direction(samples, 1);
            toward.z = i % 3 == 0 ? -toward.z : toward.z;
            if (i % 2 == 0)
                incoming = glm::normalize(glm::vec3(incoming.x, incoming.y, 1e-7f));
            const Brdf brdf({glm::vec3(0.2f), glm::vec3(0.8f, 0.5f, 0.0f), shininess}, kUp, toward);
            const Brdf::Response response = brdf.respond(incoming);
            for (int c = 0; c < 3; ++c)
                ASSERT_TRUE(std::isfinite(response.shape[c]) && response.shape[c] >= 0.0f);
            ASSERT_TRUE(std::isfinite(response.density) && response.density >= 0.0f);
            const glm::vec3 drawn = brdf.sample(samples.random(2));
            ASSERT_NEAR(glm::length(drawn), 1.0f, 1e-5f);
        }
}

TEST(Brdf, OfNothingIsBlack)
{
    const Brdf black({}, kUp, kUp);
    EXPECT_EQ(value_of(black, kUp), glm::vec3(0.0f));
}

}  // namespace
}  // namespace lumel
