// The light that lamps send into each direction.

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "base/core/pi.h"
#include "scene/values/scene.h"

using namespace lumel;

namespace {

glm::vec3 towards(float polar, float azimuth = 0.0f)
{
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
            -std::cos(polar)};
}

/// A profile whose candela are a function of (polar, azimuth).
template <typename Function>
Scene with_profile(const Function& candela)
{
    Photometry profile;
    for (int a = 0; a < Photometry::kAzimuthSteps; ++a)
        for (int p = 0; p <= Photometry::kPolarSteps; ++p)
            profile.candela.push_back(candela(kPi * float(p) / Photometry::kPolarSteps,
                                              2.0f * kPi * float(a) / Photometry::kAzimuthSteps));
    Scene scene;
    scene.profiles.push_back(profile);
    return scene;
}

}  // namespace

TEST(Intensity, APointShinesAlikeAllAround)
{
    const PunctualLight light{.color = {1, 0.5f, 0.25f}, .intensity = 80.0f};
    for (const float polar : {0.0f, 1.0f, 3.0f})
        EXPECT_EQ(intensity_towards({}, light, towards(polar)), glm::vec3(80, 40, 20));
}

TEST(Intensity, ASpotFadesBetweenItsConesAsTheExtensionSays)
{
    PunctualLight light{.kind = PunctualLight::Kind::spot, .intensity = 10.0f};
    light.inner_cone = 0.3f;
    light.outer_cone = 0.6f;
    const auto at = [&](float polar) { return intensity_towards({}, light, towards(polar)).x; };
    EXPECT_FLOAT_EQ(at(0.0f), 10.0f);
    EXPECT_FLOAT_EQ(at(0.29f), 10.0f);
    const float share = (std::cos(0.5f) - std::cos(0.6f)) / (std::cos(0.3f) - std::cos(0.6f));
    EXPECT_NEAR(at(0.5f), 10.0f * share * share, 1e-4f);
    EXPECT_EQ(at(0.61f), 0.0f);
    EXPECT_EQ(at(3.0f), 0.0f);
}

TEST(Intensity, ASpotTurnsWithItsNodeButDoesNotGrowWithIt)
{
    PunctualLight light{.kind = PunctualLight::Kind::spot, .intensity = 10.0f};
    light.inner_cone = 0.3f;
    light.outer_cone = 0.6f;
    light.transform =
        glm::scale(glm::rotate(glm::mat4(1.0f), -kPi / 2, glm::vec3(1, 0, 0)), glm::vec3(3.0f));
    EXPECT_FLOAT_EQ(intensity_towards({}, light, {0, -1, 0}).x, 10.0f);
    EXPECT_EQ(intensity_towards({}, light, {0, 0, -1}).x, 0.0f);
}

TEST(Intensity, AProfileIsReadBetweenItsValues)
{
    const Scene scene =
        with_profile([](float polar, float azimuth) { return polar + std::cos(azimuth); });
    PunctualLight light{.color = {1, 2, 3}, .intensity = 2.0f};
    light.profile = 0;
    for (const float polar : {0.004f, 0.5f, 1.234f, 3.14f})
        for (const float azimuth : {0.01f, 1.0f, 3.1f, 4.5f, 6.27f}) {
            const glm::vec3 found = intensity_towards(scene, light, towards(polar, azimuth));
            const float expected = 2.0f * (polar + std::cos(azimuth));
            // Half a step of cos: (2π / 72)² / 8 = 1e-3.
            EXPECT_NEAR(found.x, expected, 2.2e-3f);
            EXPECT_NEAR(found.z, 3.0f * expected, 6.6e-3f);
        }
}

TEST(Intensity, NadirOfAProfileIsTheLightsMinusZAndItsAzimuthGrowsFromXToY)
{
    const Scene scene = with_profile([](float polar, float azimuth) {
        return polar < 0.1f ? 7.0f : std::abs(azimuth - kPi / 2) < 0.1f ? 5.0f : 1.0f;
    });
    PunctualLight light;
    light.profile = 0;
    EXPECT_FLOAT_EQ(intensity_towards(scene, light, {0, 0, -1}).x, 7.0f);
    EXPECT_FLOAT_EQ(intensity_towards(scene, light, {0, 1, 0}).x, 5.0f);
    EXPECT_FLOAT_EQ(intensity_towards(scene, light, {0, 0, 1}).x, 1.0f);
    EXPECT_FLOAT_EQ(intensity_towards(scene, light, {0, -1, 0}).x, 1.0f);
}

TEST(Range, DarkensTowardsItsEndAndNotBeyond)
{
    PunctualLight light;
    EXPECT_EQ(range_window(light, 1e6f), 1.0f);
    light.range = 2.0f;
    EXPECT_FLOAT_EQ(range_window(light, 0.0f), 1.0f);
    EXPECT_FLOAT_EQ(range_window(light, 1.0f), 1.0f - 1.0f / 16.0f);
    EXPECT_EQ(range_window(light, 2.0f), 0.0f);
    EXPECT_EQ(range_window(light, 3.0f), 0.0f);
}
