// Skies of the CIE; tests/results/measure holds what rooms get from them.

#include "scene/sky/cie_sky.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "../support/input_error.h"
#include "scene/sky/light_options.h"

namespace lumel {
namespace {

constexpr float kLux = 5000.0f;
const SunPosition kSun{0.7, 0.6};

float luminance_at(const Sky& sky, const glm::vec3& direction)
{
    return sky_radiance(sky, direction).g;
}

TEST(CieSkies, GiveAPlaneTheirIlluminance)
{
    for (int type = 1; type <= kOvercastType; ++type) {
        const Sky sky = image_of({.type = type, .lux = kLux, .sun = kSun});
        EXPECT_NEAR(sky_irradiance(sky).g, kLux, 1e-4 * kLux) << type;
        EXPECT_EQ(luminance_at(sky, {0.6f, -0.8f, 0.0f}), 0.0f) << type;
    }
}

TEST(CieSkies, OfTypeFiveAreUniform)
{
    const Sky sky = image_of({.type = 5, .lux = kLux});
    for (const glm::vec3& direction :
         {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0.8f, 0), glm::vec3(0, 0.1f, -1)})
        EXPECT_NEAR(luminance_at(sky, glm::normalize(direction)), kLux / std::numbers::pi, 0.5);
}

/// Without a sun, a sky is as bright at the zenith, against the horizon, as its gradation says.
TEST(CieSkies, OfOvercastTypesAreBrightestAtTheZenith)
{
    const auto ratio = [](int type) {
        const Sky sky = image_of({.type = type, .lux = kLux});
        return luminance_at(sky, {0, 1, 0}) / luminance_at(sky, {1, 1e-3f, 0});
    };
    EXPECT_NEAR(ratio(1), 1.0 + 4.0 * std::exp(-0.7), 0.01);
    EXPECT_NEAR(ratio(3), 1.0 + 1.1 * std::exp(-0.8), 0.01);
    EXPECT_NEAR(ratio(16), 3.0, 0.05);
}

TEST(CieSkies, OfClearTypesAreBrightestAboutTheSunAndTheSameOnBothSidesOfIt)
{
    const glm::vec3 to_sun = direction_of(kSun);
    for (int type = 6; type <= 15; ++type) {
        const Sky sky = image_of({.type = type, .lux = kLux, .sun = kSun});
        EXPECT_GT(luminance_at(sky, to_sun), 2.0f * luminance_at(sky, {0, 1, 0})) << type;
        for (const float away : {0.3f, 1.0f}) {
            const float left =
                luminance_at(sky, direction_of({kSun.azimuth - away, kSun.elevation}));
            const float right =
                luminance_at(sky, direction_of({kSun.azimuth + away, kSun.elevation}));
            EXPECT_NEAR(left, right, 0.02f * left) << type;
            EXPECT_LT(left, luminance_at(sky, to_sun)) << type;
        }
    }
}

std::string refusal_of(const std::string& text)
{
    return test::input_error_of([&] {
        LightOptions options;
        set_sky(options, text);
        Scene scene;
        add_lights(scene, options);
    });
}

TEST(CieSkies, AreChosenByNumber)
{
    LightOptions options;
    set_sky(options, "cie:12:2500@90,30");
    Scene scene;
    add_lights(scene, options);
    EXPECT_NEAR(sky_irradiance(scene.sky).g, 2500.0, 0.5);
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_GT(luminance_at(scene.sky, direction_of({std::numbers::pi / 2, 0.52})),
              luminance_at(scene.sky, direction_of({-std::numbers::pi / 2, 0.52})));
    LightOptions with_sun;
    set_sky(with_sun, "cie:12");
    set_sun(with_sun, "90,30");
    Scene lit;
    add_lights(lit, with_sun);
    EXPECT_NEAR(sky_irradiance(lit.sky).g, 10000.0, 1.0);
    EXPECT_EQ(lit.lights.size(), 1u);
    EXPECT_EQ(refusal_of("cie:3"), "");
    EXPECT_EQ(refusal_of("cie:16:100"), "");
    EXPECT_NE(refusal_of("cie:12").find("--sun"), std::string::npos);
    for (const char* bad : {"cie:", "cie:0", "cie:17", "cie:1.5", "cie:x", "cie:3:", "cie:3:0",
                            "cie:3:-1", "cie:3:1e30", "cie:12@", "cie:12@90", "cie:12@90,-1",
                            "cie:12@90,91", "cie:12@a,b", "cie:12:5:6"})
        EXPECT_NE(refusal_of(bad).find("cie:N:LUX@AZIMUTH,ELEVATION"), std::string::npos) << bad;
}

}  // namespace
}  // namespace lumel
