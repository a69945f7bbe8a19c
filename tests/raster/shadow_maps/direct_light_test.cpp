// Direct light against closed forms.

#include "raster/shadow_maps/direct_light.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "atlas/near/near_field.h"
#include "truth/reference.h"

namespace lumel {
namespace {

using support::kPi;

/// A horizontal square at height 0 about the origin, facing up.
support::Quad floor_of(float half, int res)
{
    return {.corner = {-half, 0.0f, half},
            .edge_u = {2.0f * half, 0.0f, 0.0f},
            .edge_v = {0.0f, 0.0f, -2.0f * half},
            .res_u = res,
            .res_v = res};
}

Sky constant_sky(const glm::vec3& radiance)
{
    return {1, 1, {radiance}};
}

/// Places a light so that it shines along `direction`.
glm::mat4 shining(const glm::vec3& direction, const glm::vec3& position = glm::vec3(0.0f))
{
    const glm::vec3 z = -glm::normalize(direction);
    const glm::vec3 other =
        std::abs(z.y) < 0.9f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 x = glm::normalize(glm::cross(other, z));
    return {glm::vec4(x, 0.0f), glm::vec4(glm::cross(z, x), 0.0f), glm::vec4(z, 0.0f),
            glm::vec4(position, 1.0f)};
}

std::vector<glm::vec3> lit(const support::HandMade& made, const DirectLightOptions& options = {})
{
    const gpu::Device device;
    const World world(device, made.scene, made.lumels);
    const DirectLight light = direct_light(device, world, made.scene, made.lumels, options);
    EXPECT_EQ(device.validation_messages(), "");
    EXPECT_TRUE(light.finished);
    return light.irradiance;
}

TEST(SkyLight, OpenPlaneGetsPiTimesTheRadiance)
{
    support::HandMade plane = support::make_quads({floor_of(1.0f, 8)});
    plane.scene.sky = constant_sky({1.0f, 2.0f, 3.0f});
    for (const glm::vec3& h : lit(plane))
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(h[c], kPi * float(c + 1), 0.005f * kPi * float(c + 1));
}

TEST(SkyLight, OpenPlaneUnderAnUnevenSkyGetsItsIntegral)
{
    // A sky that darkens to the horizon and turns its colour, with a sun ten thousand times as
    // bright.
    support::HandMade plane = support::make_quads({floor_of(1.0f, 4)});
    Sky& sky = plane.scene.sky;
    sky.width = 256;
    sky.height = 128;
    for (int y = 0; y < sky.height; ++y)
        for (int x = 0; x < sky.width; ++x)
            sky.radiance.emplace_back(1.0f - float(y) / 128.0f, 0.5f, 0.2f + float(x) / 256.0f);
    sky.radiance[std::size_t(40 * 256 + 30)] = glm::vec3(1e4f);
    const glm::dvec3 truth = sky_irradiance(sky);
    for (const glm::vec3& h : lit(plane))
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(double(h[c]), truth[c], 0.01 * truth[c]);
}

TEST(SkyLight, BesideAWallItsFormFactorIsMissing)
{
    std::vector<support::Quad> quads{floor_of(1.0f, 16)};
    const glm::vec3 corners[] = {
        {-1.0f, 0.0f, -1.2f}, {1.0f, 0.0f, -1.2f}, {1.0f, 1.5f, -1.2f}, {-1.0f, 1.5f, -1.2f}};
    quads.push_back({.corner = corners[0],
                     .edge_u = corners[1] - corners[0],
                     .edge_v = corners[3] - corners[0],
                     .res_u = 16,
                     .res_v = 12});
    support::HandMade corner = support::make_quads(quads);
    corner.scene.sky = constant_sky(glm::vec3(1.0f));
    const std::vector<glm::vec3> irradiance = lit(corner);
    double square = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < corner.first[1]; ++i) {
        const glm::vec3 at = corner.lumels.lumels[i].position;
        const float hidden = polygon_form_factor(at, {0.0f, 1.0f, 0.0f}, corners, 4);
        const double truth = double(kPi) * (1.0 - double(hidden));
        square += (double(irradiance[i].x) - truth) * (double(irradiance[i].x) - truth);
        sum += truth;
    }
    const double count = double(corner.first[1]);
    EXPECT_LT(std::sqrt(square / count) / (sum / count), 0.01);
}

TEST(SkyLight, SealedBoxStaysExactlyDarkInside)
{
    std::vector<support::Quad> quads;
    support::Quad look;
    look.res_u = look.res_v = 16;
    for (const support::Quad& wall :
         support::box_walls({-0.7f, 0.0f, -0.6f}, {0.5f, 0.9f, 0.8f}, true, look))
        quads.push_back(wall);
    const std::size_t inside = 6u * 16u * 16u;
    quads.push_back(floor_of(2.0f, 24));
    quads.back().corner.y = -0.1f;
    support::HandMade box = support::make_quads(quads);
    box.scene.sky = constant_sky(glm::vec3(1e4f));
    PunctualLight sun;
    sun.kind = PunctualLight::Kind::directional;
    sun.intensity = 1e5f;
    sun.transform = shining({0.3f, -1.0f, 0.2f});
    box.scene.lights.push_back(sun);
    const std::vector<glm::vec3> irradiance = lit(box);
    for (std::size_t i = 0; i < inside; ++i)
        ASSERT_EQ(irradiance[i], glm::vec3(0.0f)) << "lumel " << i;
    EXPECT_GT(irradiance.back().x, 0.0f);
}

class Sun : public testing::TestWithParam<float> {};

TEST_P(Sun, LightsAPlaneByTheCosine)
{
    const float angle = glm::radians(60.0f);
    support::HandMade plane = support::make_quads({floor_of(1.0f, 8)});
    PunctualLight sun;
    sun.kind = PunctualLight::Kind::directional;
    sun.intensity = 1000.0f;
    sun.angle = glm::radians(GetParam());
    sun.transform = shining({std::sin(angle), -std::cos(angle), 0.0f});
    plane.scene.lights.push_back(sun);
    for (const glm::vec3& h : lit(plane))
        EXPECT_NEAR(h.x, 500.0f, 0.005f * 500.0f);
}

INSTANTIATE_TEST_SUITE_P(OfDegrees, Sun, testing::Values(0.0f, 0.27f, 5.0f));

/// A floor of 4 m with 64 lumels a side, one metre below a plate that covers x < `past` [m], under
/// a sun at 45° towards +x. The shadow ends at x = past - 1.
support::HandMade floor_under_plate(float past, float sun_angle)
{
    support::HandMade scene = support::make_quads({floor_of(2.0f, 64),
                                                   {.corner = {-4.0f, 1.0f, -4.0f},
                                                    .edge_u = {0.0f, 0.0f, 8.0f},
                                                    .edge_v = {4.0f + past, 0.0f, 0.0f},
                                                    .res_u = 16,
                                                    .res_v = 8}});
    PunctualLight sun;
    sun.kind = PunctualLight::Kind::directional;
    sun.intensity = 1.0f;
    sun.angle = sun_angle;
    sun.transform = shining({-1.0f, -1.0f, 0.0f});
    scene.scene.lights.push_back(sun);
    return scene;
}

constexpr float kFullSun = 0.70710678f;      // of 1 lx from 45° [lx]
constexpr float kFloorLumel = 4.0f / 64.0f;  // [m]

TEST(SunLight, ShadowOfAnEdgeIsSharpAndWhereItBelongs)
{
    const support::HandMade scene = floor_under_plate(0.0f, 0.0f);
    const std::vector<glm::vec3> irradiance = lit(scene);
    for (std::size_t i = 0; i < 64u * 64u; ++i) {
        const float x = scene.lumels.lumels[i].position.x;
        if (x < -1.0f - 0.6f * kFloorLumel) {
            EXPECT_EQ(irradiance[i].x, 0.0f) << x;
        } else if (x > -1.0f + 0.6f * kFloorLumel) {
            EXPECT_NEAR(irradiance[i].x, kFullSun, 0.005f * kFullSun) << x;
        }
    }
}

TEST(SunLight, LumelUnderAnEdgeIsLitByItsPartInTheSun)
{
    const std::pair<float, float> cases[] = {{0.0f, 0.2f}, {glm::radians(0.2665f), 0.7f}};
    for (const auto& [angle, part] : cases) {
        const support::HandMade scene = floor_under_plate((1.0f - part) * kFloorLumel, angle);
        const std::vector<glm::vec3> irradiance = lit(scene);
        std::size_t at_edge = 0;
        for (std::size_t i = 0; i < 64u * 64u; ++i) {
            const float x = scene.lumels.lumels[i].position.x;
            if (std::abs(x - (-1.0f + 0.5f * kFloorLumel)) > 0.1f * kFloorLumel)
                continue;
            ++at_edge;
            EXPECT_NEAR(irradiance[i].x / kFullSun, part, 0.02f) << angle;
        }
        EXPECT_EQ(at_edge, 64u);
    }
}

class PointLight : public testing::TestWithParam<float> {};

TEST_P(PointLight, LightsAFloorByTheInverseSquareAndTheCosine)
{
    const float height = 2.0f;
    support::HandMade plane = support::make_quads({floor_of(1.5f, 16)});
    PunctualLight lamp;
    lamp.intensity = 100.0f;
    lamp.radius = GetParam();
    lamp.transform[3] = glm::vec4(0.0f, height, 0.0f, 1.0f);
    plane.scene.lights.push_back(lamp);
    const std::vector<glm::vec3> irradiance = lit(plane);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const glm::vec3 at = plane.lumels.lumels[i].position;
        const float squared = height * height + at.x * at.x + at.z * at.z;
        const float truth = 100.0f * height / (squared * std::sqrt(squared));
        EXPECT_NEAR(irradiance[i].x, truth, 0.005f * truth);
    }
}

INSTANTIATE_TEST_SUITE_P(OfRadius, PointLight, testing::Values(0.0f, 0.3f));

TEST(SpotLight, FallsOffBetweenItsCones)
{
    const float height = 2.0f;
    const int res = 32;
    support::HandMade plane = support::make_quads({floor_of(2.0f, res)});
    PunctualLight lamp;
    lamp.kind = PunctualLight::Kind::spot;
    lamp.intensity = 100.0f;
    lamp.inner_cone = glm::radians(15.0f);
    lamp.outer_cone = glm::radians(35.0f);
    lamp.transform = shining({0.0f, -1.0f, 0.0f}, {0.0f, height, 0.0f});
    plane.scene.lights.push_back(lamp);
    const std::vector<glm::vec3> irradiance = lit(plane);
    const float inner = std::cos(lamp.inner_cone), outer = std::cos(lamp.outer_cone);
    const auto truth_at = [&](const glm::vec2& at) {
        const float squared = height * height + glm::dot(at, at);
        const float cosine = height / std::sqrt(squared);
        const float part = std::clamp((cosine - outer) / (inner - outer), 0.0f, 1.0f);
        return 100.0f * part * part * cosine / squared;
    };
    double square = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const glm::vec3 at = plane.lumels.lumels[i].position;
        constexpr int kSide = 8;
        double truth = 0.0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const glm::vec2 step = (glm::vec2(x, y) + 0.5f) / float(kSide) - 0.5f;
                truth += double(truth_at(glm::vec2(at.x, at.z) + step * (4.0f / float(res))));
            }
        truth /= double(kSide * kSide);
        square += (double(irradiance[i].x) - truth) * (double(irradiance[i].x) - truth);
        sum += truth;
    }
    const double count = double(irradiance.size());
    EXPECT_LT(std::sqrt(square / count) / (sum / count), 0.01);
}

TEST(PointLight, WithAProfileLightsAFloorAsItSays)
{
    // 100 cd straight down, by the cosine to the sides, and twice as much towards +x as towards -x.
    const float height = 2.0f;
    support::HandMade plane = support::make_quads({floor_of(1.5f, 32)});
    Photometry profile;
    for (int azimuth = 0; azimuth < Photometry::kAzimuthSteps; ++azimuth)
        for (int polar = 0; polar <= Photometry::kPolarSteps; ++polar) {
            const float down = std::cos(kPi * float(polar) / float(Photometry::kPolarSteps));
            const float turn = 2.0f * kPi * float(azimuth) / float(Photometry::kAzimuthSteps);
            profile.candela.push_back(std::max(down, 0.0f) * (100.0f + 33.0f * std::cos(turn)));
        }
    plane.scene.profiles.push_back(profile);
    PunctualLight lamp;
    lamp.profile = 0;
    // -z is down, +x stays.
    lamp.transform =
        glm::mat4(glm::vec4(1.0f, 0.0f, 0.0f, 0.0f), glm::vec4(0.0f, 0.0f, -1.0f, 0.0f),
                  glm::vec4(0.0f, 1.0f, 0.0f, 0.0f), glm::vec4(0.0f, height, 0.0f, 1.0f));
    plane.scene.lights.push_back(lamp);
    const std::vector<glm::vec3> irradiance = lit(plane);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const glm::vec3 at = plane.lumels.lumels[i].position;
        const float across = std::sqrt(at.x * at.x + at.z * at.z);
        if (across < 0.3f)
            continue;  // the azimuth changes much over lumels below the lamp
        const float squared = height * height + across * across;
        const float cosine = height / std::sqrt(squared);
        const float truth = (100.0f + 33.0f * at.x / across) * cosine * cosine / squared;
        EXPECT_NEAR(irradiance[i].x, truth, 0.005f * truth);
    }
}

TEST(PointLight, RangeEndsTheLight)
{
    support::HandMade plane = support::make_quads({floor_of(0.05f, 1)});
    PunctualLight lamp;
    lamp.intensity = 100.0f;
    lamp.range = 2.0f;
    lamp.transform[3] = glm::vec4(0.0f, 1.0f, 0.0f, 1.0f);
    plane.scene.lights.push_back(lamp);
    const float truth = 100.0f * (1.0f - 1.0f / 16.0f);
    EXPECT_NEAR(lit(plane)[0].x, truth, 0.005f * truth);
    plane.scene.lights[0].range = 0.9f;
    EXPECT_EQ(lit(plane)[0].x, 0.0f);
}

TEST(PointLight, OutsideTheRoomIsKeptOutByItsWalls)
{
    std::vector<support::Quad> quads;
    support::Quad look;
    look.res_u = look.res_v = 12;
    for (const support::Quad& wall :
         support::box_walls(glm::vec3(-0.5f), glm::vec3(0.5f), true, look))
        quads.push_back(wall);
    support::HandMade room = support::make_quads(quads);
    PunctualLight lamp;
    lamp.intensity = 1000.0f;
    lamp.transform[3] = glm::vec4(1.0f, 0.2f, 0.1f, 1.0f);
    room.scene.lights.push_back(lamp);
    for (const glm::vec3& h : lit(room))
        ASSERT_EQ(h, glm::vec3(0.0f));
}

/// A light of 1000 over a white floor, and panes one above the other that hide all of it.
support::HandMade floor_under(const std::vector<Material>& panes, PunctualLight::Kind kind)
{
    std::vector<support::Quad> quads{floor_of(1.0f, 32)};
    for (std::size_t i = 0; i < panes.size(); ++i) {
        quads.push_back(floor_of(3.0f, 1));
        quads.back().corner.y = 0.5f + 0.25f * float(i);
    }
    support::HandMade scene = support::make_quads(quads);
    for (std::size_t i = 0; i < panes.size(); ++i)
        scene.scene.materials[1 + i] = panes[i];
    PunctualLight light;
    light.kind = kind;
    light.intensity = 1000.0f;
    light.radius = kind == PunctualLight::Kind::point ? 0.05f : 0.0f;  // looked from 128 points
    light.transform = shining({std::sqrt(3.0f), -1.0f, 0.0f}, {0.0f, 2.0f, 0.0f});
    scene.scene.lights.push_back(light);
    return scene;
}

Material glass(const glm::vec3& color)
{
    Material material;
    material.base_color = glm::vec4(color, 1.0f);
    material.transmission = 1.0f;
    return material;
}

glm::dvec3 mean_on_floor(const support::HandMade& scene, const std::vector<glm::vec3>& irradiance)
{
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < scene.first[1]; ++i)
        sum += glm::dvec3(irradiance[i]);
    return sum / double(scene.first[1]);
}

void expect_tint(const glm::dvec3& value, double open, const glm::dvec3& tint)
{
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c], open * tint[c], 0.01 * open * tint[c]) << "channel " << c;
}

struct Panes {
    std::vector<Material> panes;
    glm::dvec3 tint;
};

Material half_there()
{
    Material grey;
    grey.alpha_mode = AlphaMode::blend;
    grey.base_color = {0.2f, 0.9f, 0.4f, 0.5f};
    return grey;
}

class ColouredLight : public testing::TestWithParam<Panes> {};

TEST_P(ColouredLight, OfTheSunFallsThroughPanes)
{
    const auto& [panes, tint] = GetParam();
    const support::HandMade scene = floor_under(panes, PunctualLight::Kind::directional);
    const double open = 500.0;  // at 60°
    expect_tint(mean_on_floor(scene, lit(scene, {.sun_directions = 32})), open, tint);
    expect_tint(
        mean_on_floor(scene, reference_irradiance(scene.scene, RayScene(scene.scene), scene.lumels,
                                                  {.samples_per_lumel = 64, .max_bounces = 0})),
        open, tint);
}

TEST_P(ColouredLight, OfALampFallsThroughPanes)
{
    const auto& [panes, tint] = GetParam();
    const support::HandMade open = floor_under({}, PunctualLight::Kind::point);
    const support::HandMade scene = floor_under(panes, PunctualLight::Kind::point);
    expect_tint(mean_on_floor(scene, lit(scene)), mean_on_floor(open, lit(open)).r, tint);
}

INSTANTIATE_TEST_SUITE_P(
    Of, ColouredLight,
    testing::Values(Panes{{glass({1.0f, 0.25f, 0.0f})}, {1.0, 0.25, 0.0}},
                    Panes{{half_there()}, {0.5, 0.5, 0.5}},
                    Panes{{glass({1.0f, 0.8f, 0.5f}), glass({0.5f, 1.0f, 0.8f})}, {0.5, 0.8, 0.4}},
                    Panes{{glass({1.0f, 1.0f, 0.6f}), half_there()}, {0.5, 0.5, 0.3}}));

/// Ends direct light by an exception, as soon as it has got that far.
void throw_at(double fraction, const support::HandMade& made)
{
    const gpu::Device device;
    const World world(device, made.scene, made.lumels);
    EXPECT_THROW(direct_light(device, world, made.scene, made.lumels, {},
                              [&](double done) -> bool {
                                  if (done >= fraction)
                                      throw std::runtime_error("enough");
                                  return true;
                              }),
                 std::runtime_error);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(DirectLight, MayBeEndedByAnException)
{
    support::HandMade scene = support::make_quads({floor_of(1.0f, 24)});
    scene.scene.sky = constant_sky(glm::vec3(1.0f));
    throw_at(0.3, scene);  // of the sky and the lamps, in this order
    scene.scene.lights.push_back({.kind = PunctualLight::Kind::point, .radius = 0.1f});
    scene.scene.lights[0].transform[3] = glm::vec4(0.0f, 1.0f, 0.0f, 1.0f);
    throw_at(0.6, scene);
}

}  // namespace
}  // namespace lumel
