// Lamps and the sky in the path tracer, against irradiance that is known.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "../support/box_lumels.h"
#include "../support/lamps.h"
#include "../support/welch.h"
#include "truth/reference.h"
#include "truth/reference_image.h"

namespace lumel {
namespace {

using support::box_walls;
using support::even_sky;
using support::HandMade;
using support::kPi;
using support::make_lamp;
using support::make_quads;
using support::Quad;
using Kind = PunctualLight::Kind;

std::vector<glm::vec3> solve(const HandMade& made, int samples, Parts parts = Parts::all,
                             std::uint32_t seed = 1)
{
    return reference_irradiance(
        made.scene, RayScene(made.scene), made.lumels,
        {.samples_per_lumel = samples, .seed = seed, .rule = SampleRule::centre, .parts = parts});
}

/// A row of lumels along x from 0, that face +z; their centres lie at y = 0.
Quad strip(float length, int lumels)
{
    Quad quad;
    quad.corner = {0.0f, -0.05f, 0.0f};
    quad.edge_u = {length, 0.0f, 0.0f};
    quad.edge_v = {0.0f, 0.1f, 0.0f};
    quad.res_u = lumels;
    return quad;
}

/// A sky of different halves, with one texel of another radiance in the upper one [cd/m²].
Sky uneven_sky(float dot)
{
    Sky sky{.width = 32, .height = 16, .radiance = {}};
    for (int row = 0; row < sky.height; ++row)
        for (int column = 0; column < sky.width; ++column)
            sky.radiance.emplace_back(row < 8 ? 1.0f : 0.1f, 0.5f, column < 16 ? 1.0f : 0.0f);
    sky.radiance[5 * 32 + 20] = glm::vec3(dot);
    return sky;
}

/// Irradiance of a plane under a sky by summation over small parts of its texels.
glm::dvec3 under(const Sky& sky, const glm::dvec3& normal)
{
    constexpr int kFine = 32;  // per texel and axis
    const int rows = sky.height * kFine, columns = sky.width * kFine;
    glm::dvec3 sum(0.0);
    for (int row = 0; row < rows; ++row) {
        const double theta = (row + 0.5) * double(kPi) / rows;
        const double angle = 2.0 * double(kPi) / columns * std::sin(theta) * double(kPi) / rows;
        for (int column = 0; column < columns; ++column) {
            const double phi = (column + 0.5) * 2.0 * double(kPi) / columns;
            const glm::dvec3 direction(-std::cos(phi) * std::sin(theta), std::cos(theta),
                                       -std::sin(phi) * std::sin(theta));
            const double cosine = std::max(0.0, glm::dot(direction, normal));
            const std::size_t texel =
                std::size_t(row / kFine) * std::size_t(sky.width) + std::size_t(column / kFine);
            sum += cosine * angle * glm::dvec3(sky.radiance[texel]);
        }
    }
    return sum;
}

TEST(Lights, APlaneUnderAnEvenSkyGetsPiTimesItsRadiance)
{
    HandMade made = make_quads({strip(1.0f, 4)});
    made.scene.sky = even_sky({1.0f, 2.0f, 4.0f});
    for (const glm::vec3& H : solve(made, 64))
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(H[c], kPi * made.scene.sky.radiance[0][c], 1e-4f * H[c]);
}

TEST(Lights, AHalfBlackSkyGivesAPlaneThatSeesBothHalvesHalfOfThat)
{
    HandMade made = make_quads({strip(1.0f, 4)});  // its normal is horizontal
    made.scene.sky = {.width = 1, .height = 2, .radiance = {glm::vec3(2.0f), glm::vec3(0.0f)}};
    for (const glm::vec3& H : solve(made, 4096))
        EXPECT_NEAR(H.x, kPi, 0.005f * kPi);
}

TEST(Lights, ASkyWithASmallBrightDotGivesWhatASumOverItsTexelsDoes)
{
    // Upright, slanting and overhead planes; rays are aimed at the sky only where a dot is bright.
    for (const float dot : {1.0f, 5e3f})
        for (const glm::vec3& normal : {glm::vec3(0, 1, 0), glm::vec3(0, 0, 1),
                                        glm::normalize(glm::vec3(1, 2, 3)), glm::vec3(0, -1, 0)}) {
            Quad quad;
            quad.edge_u = glm::normalize(glm::cross(normal, glm::vec3(0.3f, 0.5f, 0.7f)));
            quad.edge_v = glm::cross(normal, quad.edge_u);
            HandMade made = make_quads({quad});
            made.scene.sky = uneven_sky(dot);
            const glm::dvec3 truth = under(made.scene.sky, glm::dvec3(normal));
            const glm::vec3 H = solve(made, 65536)[0];
            const double tolerance = 0.005 * std::max({truth.x, truth.y, truth.z});
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(H[c], truth[c], tolerance) << "dot of " << dot;
        }
}

TEST(Lights, APointLightFallsOffWithTheSquareOfItsDistanceAndTheCosine)
{
    constexpr float kHeight = 2.0f, kCandela = 100.0f;
    HandMade made = make_quads({strip(8.0f, 16)});
    made.scene.lights.push_back(make_lamp(Kind::point, kCandela, {0.0f, 0.0f, kHeight}));
    made.scene.lights[0].color = {1.0f, 0.5f, 0.0f};
    const auto irradiance = solve(made, 1);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const float r = made.lumels.lumels[i].position.x;
        const float truth = kCandela * kHeight / std::pow(kHeight * kHeight + r * r, 1.5f);
        EXPECT_NEAR(irradiance[i].x, truth, 1e-4f * truth);
        EXPECT_NEAR(irradiance[i].y, 0.5f * truth, 1e-4f * truth);
        EXPECT_EQ(irradiance[i].z, 0.0f);
    }
}

TEST(Lights, ABallOfLightGivesAPlaneWhatItsCentreWouldUnlessItIsCutByThePlane)
{
    for (const float radius : {0.01f, 0.5f, 1.0f, 1.9f}) {
        HandMade made = make_quads({strip(3.0f, 6)});
        made.scene.lights.push_back(make_lamp(Kind::point, 100.0f, {0.0f, 0.0f, 2.0f}));
        made.scene.lights[0].radius = radius;
        const auto irradiance = solve(made, 1024);
        for (std::size_t i = 0; i < irradiance.size(); ++i) {
            const float r = made.lumels.lumels[i].position.x;
            const float truth = 200.0f / std::pow(4.0f + r * r, 1.5f);
            EXPECT_NEAR(irradiance[i].x, truth, 0.005f * truth) << "radius " << radius;
        }
    }
}

TEST(Lights, ABallThatSinksIntoAPlaneGivesTheLightOfThePartAbove)
{
    // With its centre on the horizon at distance d, half a cap of half angle α is seen, which
    // projects to the segment beyond cos α of the unit disc: ∫ cosθ dω = α - sin α cos α.
    constexpr float kDistance = 2.0f, kRadius = 1.0f;
    HandMade made = make_quads({strip(0.1f, 1)});
    made.scene.lights.push_back(make_lamp(Kind::point, 100.0f, {kDistance + 0.05f, 0.0f, 0.0f}));
    made.scene.lights[0].radius = kRadius;
    const float luminance = 100.0f / (kPi * kRadius * kRadius);
    const float alpha = std::asin(kRadius / kDistance);
    const float truth = luminance * (alpha - std::sin(alpha) * std::cos(alpha));
    EXPECT_NEAR(solve(made, 16384)[0].x, truth, 0.005f * truth);
}

TEST(Lights, InsideABallOfLightIsNone)
{
    HandMade made = make_quads({strip(0.1f, 1)});
    made.scene.lights.push_back(make_lamp(Kind::point, 100.0f, {0.0f, 0.0f, 0.5f}));
    made.scene.lights[0].radius = 1.0f;
    EXPECT_EQ(solve(made, 64)[0], glm::vec3(0.0f));
}

TEST(Lights, ARangeFadesAPointLightToNothing)
{
    HandMade made = make_quads({strip(4.0f, 16)});
    made.scene.lights.push_back(make_lamp(Kind::point, 100.0f, {0.0f, 0.0f, 2.0f}));
    made.scene.lights[0].range = 3.0f;
    const auto irradiance = solve(made, 1);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const float r = made.lumels.lumels[i].position.x;
        const float squared = 4.0f + r * r;
        const float window = std::max(0.0f, 1.0f - squared * squared / 81.0f);
        const float truth = window * 200.0f / std::pow(squared, 1.5f);
        EXPECT_NEAR(irradiance[i].x, truth, 1e-3f * truth + 1e-5f);
    }
}

TEST(Lights, ASpotIsWholeWithinItsInnerConeAndNothingOutsideItsOuterOne)
{
    HandMade made = make_quads({strip(4.0f, 32)});
    PunctualLight spot = make_lamp(Kind::spot, 100.0f, {0.0f, 0.0f, 2.0f});
    spot.inner_cone = 0.4f;
    spot.outer_cone = 0.7f;
    made.scene.lights.push_back(spot);
    const auto irradiance = solve(made, 1);
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const float r = made.lumels.lumels[i].position.x;
        const float cosine = 2.0f / std::hypot(r, 2.0f);
        const float falloff =
            std::clamp((cosine - std::cos(0.7f)) / (std::cos(0.4f) - std::cos(0.7f)), 0.0f, 1.0f);
        const float truth = falloff * falloff * 200.0f / std::pow(4.0f + r * r, 1.5f);
        EXPECT_NEAR(irradiance[i].x, truth, 1e-3f * truth);
    }
}

TEST(Lights, ParallelLightGivesItsLuxTimesTheCosineWhateverItsAngle)
{
    for (const float angle : {0.0f, 0.0047f, 0.0873f, 0.5f})
        for (const float slant : {0.0f, 0.5f, 1.0f}) {
            HandMade made = make_quads({strip(1.0f, 2)});
            PunctualLight sun = make_lamp(Kind::directional, 1000.0f, {5.0f, 6.0f, 7.0f},
                                          {std::sin(slant), 0.0f, -std::cos(slant)});
            sun.angle = angle;
            made.scene.lights.push_back(sun);
            const float truth = 1000.0f * std::cos(slant);
            for (const glm::vec3& H : solve(made, 1024))
                EXPECT_NEAR(H.x, truth, 0.002f * truth) << "angle " << angle << ", " << slant;
        }
}

/// The part of a disc of radius 1 on the side x > -edge of a straight edge.
double disc_beyond(double edge)
{
    const double x = std::clamp(edge, -1.0, 1.0);
    return 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / double(kPi);
}

TEST(Lights, BehindAnEdgeTheSunsPenumbraIsAsWideAsItsDisc)
{
    // A half-plane x < 2 at height 1 under a sun of half angle 5° overhead.
    constexpr float kAngle = 5.0f * kPi / 180.0f;
    Quad roof{{-20.0f, -20.0f, 1.0f}, {22.0f, 0.0f, 0.0f}, {0.0f, 40.0f, 0.0f}};
    roof.double_sided = true;
    roof.albedo = glm::vec3(0.0f);
    Quad floor = strip(4.0f, 160);
    floor.albedo = glm::vec3(0.0f);
    HandMade made = make_quads({floor, roof});
    PunctualLight sun = make_lamp(Kind::directional, 1000.0f, {}, {0.0f, 0.0f, -1.0f});
    sun.angle = kAngle;
    made.scene.lights.push_back(sun);
    const auto irradiance = solve(made, 4096);
    for (std::size_t i = 0; i < made.first[1]; ++i) {
        // The disc is projected with a bend of less than α² from directions to the plane.
        const double edge = double(made.lumels.lumels[i].position.x - 2.0f) / std::tan(kAngle);
        EXPECT_NEAR(irradiance[i].x, 1000.0 * disc_beyond(edge), 5.0) << "lumel " << i;
    }
}

TEST(Lights, ManyLampsAddUp)
{
    // More than there are rays for, in front of the plane and behind it.
    HandMade made = make_quads({strip(4.0f, 4)});
    for (int i = 0; i < 40; ++i) {
        const auto kind = i % 5 == 0 ? Kind::directional : (i % 5 == 1 ? Kind::spot : Kind::point);
        const float x = 0.3f * float(i % 13) - 1.0f, z = 0.2f * float(i % 7) + 0.4f;
        made.scene.lights.push_back(make_lamp(kind, float(1 + i % 3),
                                              {x, 0.1f * float(i % 4), i % 3 ? z : -z},
                                              {0.1f * float(i % 5), 0.2f, i % 2 ? -1.0f : 0.5f}));
    }
    std::vector<glm::dvec3> apart(4, glm::dvec3(0.0));
    const std::vector<PunctualLight> lights = made.scene.lights;
    for (const PunctualLight& light : lights) {
        made.scene.lights = {light};
        const auto irradiance = solve(made, 1);
        for (std::size_t i = 0; i < 4; ++i)
            apart[i] += glm::dvec3(irradiance[i]);
    }
    made.scene.lights = lights;
    const auto together = solve(made, 256);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(together[i].x, apart[i].x, 1e-4 * apart[i].x);
}

/// A room that lacks a part of its roof.
HandMade open_room(float opening)
{
    Quad look;
    look.res_u = look.res_v = 3;
    look.albedo = glm::vec3(0.7f, 0.5f, 0.3f);
    const auto walls = box_walls(glm::vec3(0.0f), glm::vec3(2.0f), true, look);
    std::vector<Quad> quads(walls.begin(), walls.end());
    quads[3].edge_u *= 1.0f - opening;  // the roof, +y
    return make_quads(quads);
}

TEST(Lights, NoSkyAndNoLampShinesIntoAClosedRoom)
{
    HandMade made = open_room(0.0f);
    made.scene.sky = uneven_sky(1e4f);
    made.scene.lights = {make_lamp(Kind::point, 1e6f, {1.0f, 3.0f, 1.0f}),
                         make_lamp(Kind::directional, 1e6f, {}, {0.3f, -1.0f, 0.2f})};
    made.scene.lights[0].radius = 0.5f;
    made.scene.lights[1].angle = 0.1f;
    for (const glm::vec3& H : solve(made, 4096))
        EXPECT_EQ(H, glm::vec3(0.0f));
}

TEST(Lights, ASkyMetByChanceAndOneThatRaysAreAimedAtLightARoomAlike)
{
    // A dot outside the view of the opening is what makes rays aim; it lights nothing itself.
    HandMade chance = open_room(0.4f);
    chance.scene.sky = uneven_sky(1.0f);
    HandMade aimed = chance;
    const std::size_t below = 14 * 32 + 3;
    aimed.scene.sky.radiance[below] = glm::vec3(1e3f);
    const double squares =
        support::mean_square(support::welch_t([&](int group, std::uint32_t seed) {
            return solve(group == 0 ? chance : aimed, 1024, Parts::all, seed);
        }));
    EXPECT_GT(squares, 0.6);
    EXPECT_LT(squares, 1.9);
}

TEST(Lights, SkyLampsAndEmittersAddUp)
{
    HandMade made = open_room(0.4f);
    made.scene.sky = uneven_sky(300.0f);
    made.scene.lights = {make_lamp(Kind::point, 2.0f, {0.5f, 1.0f, 1.0f}),
                         make_lamp(Kind::directional, 20.0f, {}, {-0.5f, -1.0f, 0.2f})};
    made.scene.materials[0].emitted = glm::vec3(1.0f, 2.0f, 3.0f);
    const auto mean_of = [](const HandMade& scene) {
        glm::dvec3 mean(0.0);
        for (const glm::vec3& H : solve(scene, 1024))
            mean += glm::dvec3(H) / double(scene.lumels.lumels.size());
        return mean;
    };

    HandMade sky = made, lamps = made, emitter = made;
    sky.scene.lights.clear();
    sky.scene.materials[0].emitted = glm::vec3(0.0f);
    lamps.scene.sky = {};
    lamps.scene.materials[0].emitted = glm::vec3(0.0f);
    emitter.scene.sky = {};
    emitter.scene.lights.clear();
    const glm::dvec3 sum = mean_of(sky) + mean_of(lamps) + mean_of(emitter);
    const glm::dvec3 together = mean_of(made);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(together[c], sum[c], 0.005 * sum[c]);
}

TEST(Lights, DirectAndIndirectLightAddUpToAll)
{
    HandMade made = open_room(0.4f);
    made.scene.sky = uneven_sky(300.0f);
    made.scene.lights = {make_lamp(Kind::point, 2.0f, {0.5f, 1.0f, 1.0f})};
    made.scene.materials[0].emitted = glm::vec3(1.0f, 2.0f, 3.0f);
    const auto all = solve(made, 256), direct = solve(made, 256, Parts::direct),
               indirect = solve(made, 256, Parts::indirect);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(direct[i][c] + indirect[i][c], all[i][c], 1e-4f * all[i][c]);
            EXPECT_GT(indirect[i][c], 0.0f);
        }
}

TEST(Lights, WithoutAnythingToReflectAllLightIsDirect)
{
    HandMade made = make_quads({strip(4.0f, 4)});
    made.scene.sky = uneven_sky(300.0f);
    made.scene.lights = {make_lamp(Kind::point, 2.0f, {0.5f, 1.0f, 1.0f})};
    const auto direct = solve(made, 64, Parts::direct);
    EXPECT_EQ(direct, solve(made, 64));
    EXPECT_GT(direct[0].x, 0.0f);
    for (const glm::vec3& H : solve(made, 64, Parts::indirect))
        EXPECT_EQ(H, glm::vec3(0.0f));
}

TEST(Lights, ThePictureOfAMatteFloorUnderLampAndSkyShowsItsIrradiance)
{
    Quad floor{{-5.0f, -5.0f, -2.0f}, {10.0f, 0.0f, 0.0f}, {0.0f, 10.0f, 0.0f}};
    floor.albedo = glm::vec3(0.5f);
    HandMade made = make_quads({floor});
    made.scene.sky = even_sky(glm::vec3(3.0f));
    made.scene.lights = {make_lamp(Kind::point, 40.0f, {0.0f, 0.0f, 0.0f})};
    const Image image =
        reference_image(made.scene, RayScene(made.scene), {.vertical_fov = 1e-3f, .aspect = 1.0f},
                        {.width = 1, .height = 1, .samples_per_pixel = 256});
    const float truth = 0.5f / kPi * (3.0f * kPi + 10.0f);
    EXPECT_NEAR(image.at(0, 0)[0], truth, 1e-3f * truth);
}

TEST(Lights, PicturesShowTheSkyBehindTheScene)
{
    // The left half of what a camera at the origin sees is a black plate.
    Quad plate{{-9.0f, -9.0f, -1.0f}, {9.0f, 0.0f, 0.0f}, {0.0f, 18.0f, 0.0f}};
    plate.albedo = glm::vec3(0.0f);
    HandMade made = make_quads({plate});
    made.scene.sky = even_sky({1.0f, 2.0f, 3.0f});
    const Image image = reference_image(made.scene, RayScene(made.scene), {.aspect = 2.0f},
                                        {.width = 2, .height = 1, .samples_per_pixel = 4});
    EXPECT_EQ(image.values, (std::vector<float>{0, 0, 0, 1, 1, 2, 3, 1}));
}

}  // namespace
}  // namespace lumel
