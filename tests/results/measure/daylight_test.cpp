// Daylight under the CIE overcast sky. What a room gets is integrated here over the window, from
// the formula of the sky, by code of its own.

#include <cmath>

#include <gtest/gtest.h>

#include "meter.h"
#include "scene/sky/cie_sky.h"

using namespace lumel;
using namespace lumel::test;
using support::Quad;

namespace {

constexpr double kLux = 10000.0;

/// A vertical plane under the overcast sky, as a part of a horizontal one:
/// ∫ L cos dω = L_z (π/6 + 4/9) against L_z 7π/9, so 3/14 + 4/(7π).
const double kVertical = 3.0 / 14.0 + 4.0 / (7.0 * kPi);

void add_sky(Scene& scene)
{
    scene.sky = image_of({.lux = float(kLux)});
}

/// A patch far below, so that there is a scene and nothing of it is seen.
Quad far_patch()
{
    return {
        .corner = {0.0f, -1.0f, 0.0f}, .edge_u = {0.1f, 0.0f, 0.0f}, .edge_v = {0.0f, 0.0f, -0.1f}};
}

/// A black room 4 × 3 × 6 m whose wall x = 0 has a window from z1 to z2 and from y1 to y2.
struct SideLit {
    double width = 4.0, height = 3.0, depth = 6.0;
    double z1 = 2.0, z2 = 4.0, y1 = 1.0, y2 = 2.4;

    std::vector<Quad> quads() const
    {
        std::vector<Quad> all;
        const auto walls =
            support::box_walls({0.0f, 0.0f, 0.0f}, {float(width), float(height), float(depth)},
                               true, {.albedo = glm::vec3(0.0f)});
        all.assign(walls.begin() + 1, walls.end());  // all but x = 0
        add_strip(all, 0.0, height, 0.0, z1);
        add_strip(all, 0.0, height, z2, depth);
        add_strip(all, 0.0, y1, z1, z2);
        add_strip(all, y2, height, z1, z2);
        return all;
    }

    /// Sky component at a point that faces up, as a part of LUX, over M × M parts of the window:
    /// Σ L(θ) sin θ cos φ dA / r², with sin θ = y / r and cos φ = x / r.
    double sky_component(const glm::dvec3& point) const
    {
        constexpr int kParts = 2000;
        const double zenith = 9.0 / (7.0 * kPi);  // luminance for one lux outdoors
        const double dy = (y2 - y1) / kParts, dz = (z2 - z1) / kParts;
        double sum = 0.0;
        for (int i = 0; i < kParts; ++i)
            for (int j = 0; j < kParts; ++j) {
                const double y = y1 + (i + 0.5) * dy - point.y, z = z1 + (j + 0.5) * dz - point.z;
                if (y <= 0.0)
                    continue;
                const double squared = point.x * point.x + y * y + z * z;
                const double sine = y / std::sqrt(squared);
                sum += (1.0 + 2.0 * sine) / 3.0 * sine * (point.x / std::sqrt(squared)) / squared;
            }
        return zenith * sum * dy * dz;
    }

private:
    /// A part of the wall x = 0, seen from the room.
    static void add_strip(std::vector<Quad>& all, double low, double high, double from, double to)
    {
        all.push_back({.corner = {0.0f, float(low), float(from)},
                       .edge_u = {0.0f, float(high - low), 0.0f},
                       .edge_v = {0.0f, 0.0f, float(to - from)},
                       .albedo = glm::vec3(0.0f)});
    }
};

}  // namespace

TEST(OvercastSky, GivesAnOpenHorizontalPlaneWhatWasAskedFor)
{
    const MeteredRoom open({far_patch()}, 0.0f, add_sky);
    EXPECT_NEAR(open.read({{0.0f, 0.0f, 0.0f}}).lux, kLux, kAccuracy * kLux);
    EXPECT_NEAR(sky_irradiance(image_of({.lux = 5000.0f})).g, 5000.0, 0.01);
}

TEST(OvercastSky, GivesAVerticalPlaneTwoFifthsOfThat)
{
    EXPECT_NEAR(kVertical, 0.396, 5e-4);
    const MeteredRoom open({far_patch()}, 0.0f, add_sky);
    for (const glm::vec3& normal : {glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(0.0f, 0.0f, -1.0f)})
        EXPECT_NEAR(open.read({{0.0f, 0.0f, 0.0f}, normal}).lux, kVertical * kLux,
                    kAccuracy * kVertical * kLux);
    EXPECT_EQ(open.read({{0.0f, 0.0f, 0.0f}, {0.0f, -1.0f, 0.0f}}).inside, false);
}

TEST(OvercastSky, IsThreeTimesAsBrightAtTheZenithAsAtTheHorizon)
{
    const Sky sky = image_of({.lux = float(kLux)});
    const double zenith = 9.0 * kLux / (7.0 * kPi);
    EXPECT_NEAR(sky_radiance(sky, {0.0f, 1.0f, 0.0f}).g, zenith, 0.001 * zenith);
    // The row above the horizon is 1.4° high.
    EXPECT_NEAR(sky_radiance(sky, {1.0f, 1e-3f, 0.0f}).g, zenith / 3.0, 0.03 * zenith / 3.0);
    EXPECT_EQ(sky_radiance(sky, {1.0f, -1e-3f, 0.0f}).g, 0.0f);
}

TEST(DaylightFactor, OfABlackSideLitRoomIsTheSkyComponentOfItsWindow)
{
    const SideLit room;
    const MeteredRoom metered(room.quads(), 0.0f, add_sky);
    for (const glm::dvec3& point :
         {glm::dvec3(1.0, 0.85, 3.0), glm::dvec3(2.0, 0.85, 2.2), glm::dvec3(3.5, 0.0, 3.0)}) {
        const double expected = kLux * room.sky_component(point);
        const Reading reading = metered.read({glm::vec3(point)}, 1 << 19);
        EXPECT_NEAR(reading.lux, expected, kAccuracy * expected) << point.x;
    }
}
