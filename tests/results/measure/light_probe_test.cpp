// Light probes against closed forms. Spherical harmonics are written here once more, in angles.

#include <cmath>

#include <gtest/gtest.h>

#include "../../support/lamps.h"
#include "base/core/error.h"
#include "meter.h"
#include "results/measure/probe_grid.h"

using namespace lumel;
using namespace lumel::test;
using support::Quad;

namespace {

using Nine = std::array<double, 9>;

/// Real harmonics of (l, m) at polar angle θ from +z and azimuth φ from +x, by their definition
/// with associated Legendre functions: N P_l^|m|(cos θ) √2 cos mφ, or sin |m|φ for m < 0.
Nine harmonics_of(const glm::dvec3& direction)
{
    const glm::dvec3 d = glm::normalize(direction);
    const double cosine = d.z, sine = std::sqrt(1.0 - cosine * cosine), phi = std::atan2(d.y, d.x);
    const double n0 = 0.5 / std::sqrt(kPi), n1 = std::sqrt(0.75 / kPi), n2 = std::sqrt(1.25 / kPi);
    const double p21 = std::sqrt(3.0) * sine * cosine, p22 = 0.5 * std::sqrt(3.0) * sine * sine;
    return {n0,
            n1 * sine * std::sin(phi),
            n1 * cosine,
            n1 * sine * std::cos(phi),
            n2 * p22 * std::sin(2.0 * phi),
            n2 * p21 * std::sin(phi),
            n2 * 0.5 * (3.0 * cosine * cosine - 1.0),
            n2 * p21 * std::cos(phi),
            n2 * p22 * std::cos(2.0 * phi)};
}

/// Each coefficient is right to 0.5 % of that of band 0.
void expect_coefficients(const ProbeLight& probe, const Nine& expected)
{
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(double(probe.coefficients[i].g), expected[i], kAccuracy * expected[0])
            << "coefficient " << i << ", stated noise " << probe.noise;
    EXPECT_LT(probe.noise, kAccuracy * expected[0]);
    EXPECT_FALSE(probe.inside);
}

/// So far away that it blocks nothing.
Quad speck()
{
    return {.corner = {0.0f, -1000.0f, 0.0f},
            .edge_u = {0.1f, 0.0f, 0.0f},
            .edge_v = {0.0f, 0.0f, -0.1f},
            .albedo = glm::vec3(0.0f)};
}

}  // namespace

TEST(LightProbe, UnderAnEvenSkyHasTwiceTheRootOfPiTimesItsRadianceAndNothingElse)
{
    const MeteredRoom open({speck()}, 0.0f,
                           [](Scene& scene) { scene.sky = support::even_sky(glm::vec3(50.0f)); });
    Nine expected{};
    expected[0] = 2.0 * std::sqrt(kPi) * 50.0;
    expect_coefficients(open.probe({0.0f, 0.0f, 0.0f}), expected);
}

// Of radiance L above the horizon, +y: √π L, and ∫ L Y_1,-1 = √(3/4π) L π. Band 2 is even, so that
// a half gives half of nothing.
TEST(LightProbe, UnderHalfASkyHasHalfOfThatAndItsDirection)
{
    const MeteredRoom open({speck()}, 0.0f, [](Scene& scene) {
        scene.sky = {.width = 1, .height = 2, .radiance = {glm::vec3(50.0f), glm::vec3(0.0f)}};
    });
    Nine expected{};
    expected[0] = std::sqrt(kPi) * 50.0;
    expected[1] = std::sqrt(0.75 * kPi) * 50.0;
    expect_coefficients(open.probe({0.0f, 0.0f, 0.0f}), expected);
}

TEST(LightProbe, OfAPointLampHasItsIntensityOverTheSquareOfTheDistanceInOneDirection)
{
    const glm::vec3 lamp(0.6f, 2.0f, -0.4f), place(-0.2f, 0.7f, 0.3f);
    const MeteredRoom room({speck()}, 0.0f, [&](Scene& scene) {
        scene.lights = {support::make_lamp(PunctualLight::Kind::point, 900.0f, lamp)};
    });
    const glm::dvec3 to = glm::dvec3(lamp) - glm::dvec3(place);
    Nine expected = harmonics_of(to);
    for (double& value : expected)
        value *= 900.0 / glm::dot(to, to);
    const ProbeLight probe = room.probe(place, 64);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(double(probe.coefficients[i].g), expected[i], 1e-5 * expected[0]) << i;
    EXPECT_LT(probe.noise, 1e-5 * expected[0]);
}

TEST(LightProbe, OfASunHasItsIlluminanceInOneDirection)
{
    const glm::vec3 along(0.3f, -0.8f, 0.5f);
    const MeteredRoom room({speck()}, 0.0f, [&](Scene& scene) {
        scene.lights = {support::make_lamp(PunctualLight::Kind::directional, 80000.0f, {}, along)};
    });
    Nine expected = harmonics_of(-glm::dvec3(along));
    for (double& value : expected)
        value *= 80000.0;
    const ProbeLight probe = room.probe({0.0f, 1.0f, 0.0f}, 64);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(double(probe.coefficients[i].g), expected[i], 1e-5 * expected[0]) << i;
}

TEST(LightProbe, BehindAScreenHasNothingOfALamp)
{
    const Quad screen{.corner = {-1.0f, 1.0f, 1.0f},
                      .edge_u = {2.0f, 0.0f, 0.0f},
                      .edge_v = {0.0f, 0.0f, -2.0f},
                      .albedo = glm::vec3(0.0f),
                      .double_sided = true};
    const MeteredRoom room({screen}, 0.0f, [&](Scene& scene) {
        scene.lights = {support::make_lamp(PunctualLight::Kind::point, 900.0f, {0.0f, 2.0f, 0.0f})};
    });
    EXPECT_EQ(room.probe({0.1f, 0.5f, 0.0f}, 64).coefficients[0].g, 0.0f);
    EXPECT_GT(room.probe({0.1f, 1.5f, 0.0f}, 64).coefficients[0].g, 0.0f);
}

TEST(LightProbe, OfManyPointLampsIsTheirSum)
{
    // More than have rays of their own.
    constexpr int kSide = 40;
    const glm::vec3 place(0.1f, 0.5f, 0.2f);
    Nine expected{};
    const MeteredRoom room({speck()}, 0.0f, [&](Scene& scene) {
        for (int i = 0; i < kSide * kSide; ++i) {
            const glm::vec3 at(0.2f * float(i % kSide) - 4.0f, 3.0f,
                               0.2f * float(i / kSide) - 4.0f);
            scene.lights.push_back(support::make_lamp(PunctualLight::Kind::point, 1.0f, at));
            const glm::dvec3 to = glm::dvec3(at) - glm::dvec3(place);
            const Nine y = harmonics_of(to);
            for (std::size_t k = 0; k < y.size(); ++k)
                expected[k] += y[k] / glm::dot(to, to);
        }
    });
    expect_coefficients(room.probe(place), expected);
}

// The light of a rectangle by quadrature over it: E/π Y(ω) cos dA / r².
TEST(LightProbe, BesideAnEmissiveRectangleHasItsLight)
{
    const Quad lamp = panel({-0.3f, 2.5f, -0.2f}, 1.0f, 0.7f, 0.0f, 2000.0f);
    const MeteredRoom room({speck(), lamp}, 0.0f, kNothingElse);
    for (const glm::dvec3& place : {glm::dvec3(0.0, 0.8, 0.0), glm::dvec3(0.5, 2.3, 0.1)}) {
        constexpr int kSteps = 1000;
        Nine expected{};
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const glm::dvec3 to =
                    glm::dvec3(-0.3 + (i + 0.5) / kSteps, 2.5, -0.2 + 0.7 * (j + 0.5) / kSteps) -
                    place;
                const double squared = glm::dot(to, to), cosine = to.y / std::sqrt(squared);
                const Nine y = harmonics_of(to);
                for (std::size_t k = 0; k < y.size(); ++k)
                    expected[k] += y[k] * 2000.0 / kPi * cosine / squared * 0.7 / (kSteps * kSteps);
            }
        expect_coefficients(room.probe(glm::vec3(place)), expected);
    }
}

TEST(LightProbe, InAFurnaceHasTheSameLightFromEverywhere)
{
    const float albedo = 0.7f, emission = 300.0f, arriving = emission / (1.0f - albedo);
    const auto walls = support::box_walls(
        {0.0f, 0.0f, 0.0f}, {3.0f, 2.5f, 4.0f}, true,
        {.albedo = glm::vec3(albedo), .emission = glm::vec3(emission), .res_u = 4, .res_v = 4});
    const MeteredRoom room({walls.begin(), walls.end()}, arriving, kNothingElse);
    Nine expected{};
    expected[0] = 2.0 * std::sqrt(kPi) * double(arriving) / kPi;
    for (const glm::vec3& place : {glm::vec3(1.5f, 1.2f, 2.0f), glm::vec3(0.1f, 0.2f, 3.9f)})
        expect_coefficients(room.probe(place), expected);
}

TEST(LightProbe, InsideOfABlockIsSaidToBeInside)
{
    const auto block = support::box_walls({-0.5f, 0.0f, -0.5f}, {0.5f, 1.0f, 0.5f}, false);
    const MeteredRoom room({block.begin(), block.end()}, 100.0f, kNothingElse);
    EXPECT_TRUE(room.probe({0.0f, 0.5f, 0.0f}).inside);
    EXPECT_TRUE(room.probe({0.45f, 0.95f, -0.45f}).inside);
    EXPECT_FALSE(room.probe({0.0f, 1.5f, 0.0f}).inside);
    EXPECT_FALSE(room.probe({0.51f, 0.5f, 0.0f}).inside);
}

TEST(ProbeGrid, FillsABoxWithTheSameMarginOnOppositeSides)
{
    const ProbeGrid grid = probe_grid({0.0, 0.0, -1.0}, {2.1, 0.4, 2.0}, 0.5);
    EXPECT_EQ(grid.counts, glm::ivec3(4, 1, 6));
    const std::vector<glm::dvec3> points = grid.points();
    ASSERT_EQ(points.size(), 24u);
    EXPECT_NEAR(points[0].x, 0.3, 1e-12);
    EXPECT_NEAR(points[0].y, 0.2, 1e-12);
    EXPECT_NEAR(points[0].z, -0.75, 1e-12);
    EXPECT_NEAR(points[1].x, 0.8, 1e-12);
    EXPECT_NEAR(points[4].z, -0.25, 1e-12);
    EXPECT_NEAR(points.back().z, 1.75, 1e-12);
    EXPECT_THROW(probe_grid(glm::dvec3(0.0), glm::dvec3(1000.0), 1.0), Error);
}
