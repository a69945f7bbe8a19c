// Lights that the command line adds.

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "../support/input_error.h"
#include "base/core/luminance.h"
#include "base/core/pi.h"
#include "base/images/image_files.h"
#include "gltf_builder.h"
#include "scene/sky/clear_sky.h"
#include "scene/sky/light_options.h"

using namespace lumel;
using namespace lumel::test;

namespace {

const char* const kLamp = "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 1\n0 90 0 30 30\n";

Scene with_lights()
{
    Scene scene;
    scene.lights = {{.kind = PunctualLight::Kind::point, .name = "bulb", .intensity = 50.0f},
                    {.kind = PunctualLight::Kind::spot, .name = "spot"},
                    {.kind = PunctualLight::Kind::directional, .name = "day"}};
    return scene;
}

}  // namespace

TEST(LightOptions, NothingAskedForChangesNothing)
{
    Scene scene = one_triangle().read();
    const std::string hash = scene.hash;
    add_lights(scene, {});
    EXPECT_EQ(scene.hash, hash);
    EXPECT_TRUE(scene.sky.empty());
}

TEST(LightOptions, AConstantSkyLightsAPlaneWithPiTimesItsRadiance)
{
    LightOptions options;
    set_sky(options, "1,2,0.5");
    options.sky_scale = 3.0f;
    Scene scene;
    add_lights(scene, options);
    const glm::dvec3 irradiance = sky_irradiance(scene.sky);
    EXPECT_NEAR(irradiance.r, 3.0 * std::acos(-1.0), 1e-4);
    EXPECT_NEAR(irradiance.g, 6.0 * std::acos(-1.0), 1e-4);
    EXPECT_NEAR(irradiance.b, 1.5 * std::acos(-1.0), 1e-4);
}

TEST(LightOptions, TheOvercastSkyGivesAPlaneItsIlluminance)
{
    for (const auto& [text, lux] :
         {std::pair{"overcast", 10000.0}, std::pair{"overcast:750", 750.0}}) {
        LightOptions options;
        set_sky(options, text);
        Scene scene;
        add_lights(scene, options);
        EXPECT_NEAR(luminance(sky_irradiance(scene.sky)), lux, 1e-5 * lux);
    }
    for (const char* bad : {"overcast:", "overcast:0", "overcast:-5", "overcast:much",
                            "overcast:1e30", "overcast:1e-60"})
        EXPECT_NE(input_error_of([&] {
                      LightOptions options;
                      set_sky(options, bad);
                  }).find("overcast:LUX"),
                  std::string::npos)
            << bad;
}

TEST(LightOptions, ASkyFileTakesThePlaceOfTheScenesSky)
{
    const TempFolder folder;
    Image image(2, 2, 3);
    image.values.assign(12, 7.0f);
    write_exr(folder.path("1,2,sky.exr"), image, Precision::float32, {});
    LightOptions options;
    set_sky(options, folder.path("1,2,sky.exr"));
    Scene scene;
    scene.sky = {.width = 1, .height = 1, .radiance = {glm::vec3(1.0f)}};
    add_lights(scene, options);
    EXPECT_EQ(scene.sky.width, 2);
    EXPECT_EQ(scene.sky.radiance[3], glm::vec3(7.0f));
}

TEST(LightOptions, TheSunBringsItsSkyUnlessThereIsAnother)
{
    LightOptions options;
    set_sun(options, "90,30");
    Scene scene;
    add_lights(scene, options);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_LT(glm::distance(glm::vec3(scene.lights[0].transform[2]),
                            glm::vec3(std::cos(0.5235988f), 0.5f, 0.0f)),
              1e-5f);
    EXPECT_NEAR(scene.lights[0].angle, kSunAngle, 1e-7f);
    EXPECT_NEAR(luminance(sky_irradiance(scene.sky)), clear_sky_illuminance(glm::radians(30.0)),
                10.0);

    set_sky(options, "0,0,0");
    options.sun_angle = 0.1f;
    Scene under_black;
    add_lights(under_black, options);
    EXPECT_EQ(sky_irradiance(under_black.sky).r, 0.0);
    ASSERT_EQ(under_black.lights.size(), 1u);
    EXPECT_FLOAT_EQ(under_black.lights[0].angle, 0.1f);
}

TEST(LightOptions, SunAndSkyTurnTogether)
{
    LightOptions options;
    set_sun(options, "90,30");
    options.sky_rotation = glm::radians(90.0);  // east to north
    Scene scene;
    add_lights(scene, options);
    const glm::vec3 to_sun = glm::vec3(scene.lights[0].transform[2]);
    EXPECT_LT(glm::distance(to_sun, {0.0f, 0.5f, -std::cos(0.5235988f)}), 1e-5f);
    EXPECT_GT(luminance(sky_radiance(scene.sky, to_sun)),
              3.0 * luminance(sky_radiance(scene.sky, {-to_sun.z, to_sun.y, 0.0f})));
}

/// Irradiance of an open plane that faces down.
glm::dvec3 from_below(Sky sky)
{
    std::ranges::reverse(sky.radiance);
    return sky_irradiance(sky);
}

TEST(LightOptions, TheGroundReflectsSkyAndSun)
{
    constexpr float kAlbedo = 0.25f;
    constexpr double kElevation = glm::radians(30.0);
    const auto lit = [](const LightOptions& options) {
        Scene scene;
        add_lights(scene, options);
        return scene;
    };
    LightOptions overcast, clear, coloured, image;
    set_sky(overcast, "overcast:8000");
    set_sun(clear, "90,30");
    set_sky(coloured, "1,2,4");
    for (LightOptions* options : {&overcast, &clear, &coloured, &image})
        options->ground = kAlbedo;
    EXPECT_NEAR(luminance(from_below(lit(overcast).sky)), 2000.0, 2.0);
    EXPECT_NEAR(luminance(sky_irradiance(lit(overcast).sky)), 8000.0, 8.0);
    EXPECT_NEAR(luminance(from_below(lit(clear).sky)),
                kAlbedo * (clear_sky_illuminance(kElevation) +
                           sun_illuminance(kElevation) * std::sin(kElevation)),
                10.0);
    EXPECT_NEAR(from_below(lit(coloured).sky).b, kAlbedo * 4.0 * kPi, 0.02);
    overcast.sky_scale = 0.5f;
    EXPECT_NEAR(luminance(from_below(lit(overcast).sky)), 1000.0, 1.0);
    EXPECT_TRUE(warns(lit(image), "--ground has no effect"));
}

TEST(LightOptions, ASunBelowTheHorizonGivesAWarning)
{
    LightOptions options;
    set_sun(options, "47.5,19.0,2024-06-21T23:00:00Z");
    Scene scene;
    add_lights(scene, options);
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_TRUE(warns(scene, "below the horizon"));
    EXPECT_EQ(sky_irradiance(scene.sky).r, 0.0);
}

TEST(LightOptions, SizesAreForLightsThatHaveNone)
{
    LightOptions options;
    options.light_radius = 0.2f;
    options.sun_angle = 0.01f;
    Scene scene = with_lights();
    scene.lights[1].radius = 0.5f;
    add_lights(scene, options);
    EXPECT_FLOAT_EQ(scene.lights[0].radius, 0.2f);
    EXPECT_FLOAT_EQ(scene.lights[1].radius, 0.5f);
    EXPECT_FLOAT_EQ(scene.lights[2].angle, 0.01f);
    EXPECT_EQ(scene.lights[2].radius, 0.0f);
}

TEST(LightOptions, ThoseWithoutEffectGiveAWarning)
{
    LightOptions scale, rotation, angle, radius;
    scale.sky_scale = 2.0f;
    rotation.sky_rotation = 1.0;
    angle.sun_angle = 0.01f;
    radius.light_radius = 0.2f;
    const auto warnings = [](Scene scene, const LightOptions& options) {
        add_lights(scene, options);
        return scene.warnings;
    };
    const auto expect_idle = [&](const LightOptions& options, const std::string& name) {
        const std::vector<std::string> dark = warnings({}, options);
        ASSERT_EQ(dark.size(), 1u) << name;
        EXPECT_TRUE(dark.front().starts_with(name + " has no effect: ")) << dark.front();
        Scene with_sizes = with_lights();
        for (PunctualLight& light : with_sizes.lights)
            light.radius = light.angle = 0.1f;
        EXPECT_EQ(warnings(with_sizes, options), dark);
    };
    expect_idle(scale, "--sky-scale");
    expect_idle(rotation, "--sky-rotation");
    expect_idle(angle, "--sun-angle");
    expect_idle(radius, "--light-radius");
    set_sky(rotation, "overcast");
    expect_idle(rotation, "--sky-rotation");
    set_sky(rotation, "1,2,3");
    expect_idle(rotation, "--sky-rotation");

    set_sky(scale, "1,2,3");
    set_sun(rotation, "90,30");
    EXPECT_EQ(warnings({}, scale), std::vector<std::string>());
    EXPECT_EQ(warnings({}, rotation), std::vector<std::string>());
    EXPECT_EQ(warnings(with_lights(), angle), std::vector<std::string>());
    EXPECT_EQ(warnings(with_lights(), radius), std::vector<std::string>());
    LightOptions turned_sky;
    set_sky(turned_sky, "cie:12@90,30");
    turned_sky.sky_rotation = 1.0;
    EXPECT_EQ(warnings({}, turned_sky), std::vector<std::string>());
    set_sun(angle, "90,30");
    EXPECT_EQ(warnings({}, angle), std::vector<std::string>());
}

TEST(LightOptions, ASunOfAPlaceAndTimeIsKeptAsItWasGiven)
{
    LightOptions options;
    set_sun(options, "47.5,19.0,2024-06-21T14:00:00+02:00");
    ASSERT_TRUE(options.sun_seen);
    EXPECT_EQ(options.sun_seen->latitude, 47.5);
    EXPECT_EQ(options.sun_seen->longitude, 19.0);
    EXPECT_EQ(options.sun_seen->time, "2024-06-21T14:00:00+02:00");
    LightOptions in_utc;
    set_sun(in_utc, "47.5,19.0,2024-06-21T12:00:00Z");
    EXPECT_EQ(options.sun->azimuth, in_utc.sun->azimuth);
    EXPECT_EQ(options.sun->elevation, in_utc.sun->elevation);
    set_sun(options, "180,40");
    EXPECT_FALSE(options.sun_seen);
}

TEST(LightOptions, AStarStandsForAnyLettersInTheNamesOfLamps)
{
    const TempFolder folder;
    const std::string file = folder.write("lamp.ies", std::string(kLamp));
    const auto lit = [&](const std::string& pattern) {
        Scene scene;
        for (const char* name : {"downlight", "downlight.001", "downlight.012", "uplight", "a*b"})
            scene.lights.push_back({.kind = PunctualLight::Kind::point, .name = name});
        LightOptions options;
        add_profile(options, pattern + "=" + file);
        add_lights(scene, options);
        std::string found;
        for (const PunctualLight& light : scene.lights)
            found += light.profile >= 0 ? '1' : '0';
        return found;
    };
    EXPECT_EQ(lit("downlight"), "10000");
    EXPECT_EQ(lit("downlight*"), "11100");
    EXPECT_EQ(lit("downlight.*"), "01100");
    EXPECT_EQ(lit("*light"), "10010");
    EXPECT_EQ(lit("*light*1*"), "01100");
    EXPECT_EQ(lit("*"), "11111");
    EXPECT_EQ(lit("a*b"), "00001");
    EXPECT_TRUE(contains(input_error_of([&] { lit("*lights"); }), "\"*lights\""));
}

TEST(LightOptions, LampsThatProfilesLeaveOutAreNamed)
{
    const TempFolder folder;
    const std::string file = folder.write("lamp.ies", std::string(kLamp));
    LightOptions options;
    add_profile(options, "bulb=" + file);
    Scene scene = with_lights();
    add_lights(scene, options);
    EXPECT_TRUE(warns(scene, "--ies leaves out \"spot\""));
    EXPECT_FALSE(warns(scene, "\"day\""));  // which can have none

    add_profile(options, "sp*=" + file);
    Scene all = with_lights();
    add_lights(all, options);
    EXPECT_FALSE(warns(all, "leaves out"));
    Scene none = with_lights();
    add_lights(none, {});
    EXPECT_FALSE(warns(none, "leaves out"));
}

TEST(LightOptions, PointLightsWhoseProfileShinesSidewaysAreNamed)
{
    const TempFolder folder;
    LightOptions options;
    add_profile(options, "bulb=" + folder.write("lamp.ies", std::string(kLamp)));
    Scene level = with_lights();
    add_lights(level, options);
    EXPECT_TRUE(warns(level, "\"bulb\" shines sideways"));

    Scene down = with_lights();
    for (PunctualLight& light : down.lights)
        light.transform = glm::rotate(light.transform, -kPi / 2.0f, glm::vec3(1, 0, 0));
    add_lights(down, options);
    EXPECT_FALSE(warns(down, "shines sideways"));
}

TEST(LightOptions, AProfileReplacesTheIntensityOfALight)
{
    const TempFolder folder;
    LightOptions options;
    add_profile(options, "bulb=" + folder.write("a=b.ies", std::string(kLamp)));
    Scene scene = with_lights();
    add_lights(scene, options);
    EXPECT_EQ(scene.lights[0].profile, 0);
    EXPECT_EQ(scene.lights[1].profile, -1);
    EXPECT_FLOAT_EQ(intensity_towards(scene, scene.lights[0], {0, 0, -1}).x, 30.0f);
    EXPECT_FLOAT_EQ(intensity_towards(scene, scene.lights[0], {0, 0, 1}).x, 0.0f);
}

TEST(LightOptions, AProfileForNoLightNamesThoseThereAre)
{
    const TempFolder folder;
    const std::string file = folder.write("lamp.ies", std::string(kLamp));
    LightOptions options;
    options.profiles = {{"day", file}};
    Scene scene = with_lights();
    const std::string error = input_error_of([&] { add_lights(scene, options); });
    EXPECT_TRUE(contains(error, "no point or spot light \"day\"; it has \"bulb\", \"spot\""))
        << error;
    Scene dark;
    EXPECT_TRUE(contains(input_error_of([&] { add_lights(dark, options); }), "nor any other"));
}

TEST(LightOptions, EveryLightCountsInTheHash)
{
    const auto hash_with = [](const LightOptions& options) {
        Scene scene = with_lights();
        add_lights(scene, options);
        return scene.hash;
    };
    LightOptions sky, turned_sky, sun, radius, angle;
    set_sky(sky, "1,1,1");
    set_sky(turned_sky, "1,1,2");
    set_sun(sun, "10,40");
    radius.light_radius = 0.1f;
    angle.sun_angle = 0.1f;
    const std::vector<std::string> hashes = {hash_with({}),         hash_with(sky),
                                             hash_with(turned_sky), hash_with(sun),
                                             hash_with(radius),     hash_with(angle)};
    for (std::size_t i = 0; i < hashes.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_NE(hashes[i], hashes[k]) << i << " and " << k;
}

TEST(LightOptions, MistakesAreNamed)
{
    LightOptions options;
    EXPECT_TRUE(contains(input_error_of([&] { set_sky(options, "1,2"); }), "--sky"));
    EXPECT_TRUE(contains(input_error_of([&] { set_sky(options, "1,-2,1"); }), "0 or more"));
    EXPECT_TRUE(contains(input_error_of([&] { set_sky(options, "1e39,0,0"); }), "too bright"));
    for (const char* text : {"", "nan", "nan,1,1", "inf,1,1", "1e400,1,1", "1,1,1e400", "sky.png"})
        EXPECT_TRUE(contains(input_error_of([&] { set_sky(options, text); }), "R,G,B")) << text;
    for (const char* text : {"", "1", "1,x", "1,2,3", "1,2,3,4", "1,91", "91,0,2024-06-21T12:00",
                             "0,181,2024-06-21T12:00"})
        EXPECT_NE(input_error_of([&] { set_sun(options, text); }), "") << text;
    for (const char* text : {"", "lamp", "=file", "lamp="})
        EXPECT_TRUE(contains(input_error_of([&] { add_profile(options, text); }), "LIGHT=FILE"))
            << text;
}
