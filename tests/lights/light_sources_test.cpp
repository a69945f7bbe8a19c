// Samples of sources against what the sources send by closed forms.

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "../support/closed_forms.h"
#include "../support/lamps.h"
#include "../support/quadrature.h"
#include "atlas/prepare/solve_scene.h"
#include "lit_point.h"

namespace lumel {
namespace {

using support::mean_of_samples;
using support::upward;

constexpr float kExtent = 2.0f;  // of the scenes [m]

struct Place {
    Span x, y;
    double height;
};

/// Beside, above, and so near that triangles are sampled by solid angle.
constexpr Place kPlaces[] = {{{-0.5, 0.5}, {-0.5, 0.5}, 1.0},
                             {{0.3, 1.1}, {0.2, 0.9}, 0.5},
                             {{-1.0, 1.0}, {-0.7, 1.3}, 0.1}};

/// A plate of side² pieces in one mesh.
Scene plate(const Place& place, int side, const glm::vec3& emission)
{
    Scene scene;
    const support::Quad whole = support::plate_above({float(place.x.low), float(place.y.low)},
                                                     {float(place.x.high), float(place.y.high)},
                                                     float(place.height), emission);
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (int k = 0; k < side * side; ++k) {
        const glm::vec3 u = whole.edge_u / float(side), v = whole.edge_v / float(side),
                        a = whole.corner + float(k % side) * u + float(k / side) * v;
        const auto first = std::uint32_t(positions.size());
        for (const glm::vec3& corner : {a, a + u, a + u + v, a + v})
            positions.push_back(corner);
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
            indices.push_back(first + corner);
    }
    Material material;
    material.emitted = emission / support::kPi;
    support::add_mesh(scene, positions, indices, material);
    return scene;
}

TEST(LightSources, AUniformPlateSendsItsEmissionTimesItsFormFactor)
{
    const glm::vec3 emission(3.0f, 2.0f, 1.0f);
    for (const Place& place : kPlaces)
        for (const int side : {1, 2, 5}) {  // form factors of few triangles, points on many
            const Scene scene = plate(place, side, emission);
            const Surfaces surfaces(scene);
            const LightSources sources(scene, surfaces, kExtent);
            ASSERT_EQ(sources.count(), 1u);
            const double factor = point_to_parallel_rectangle(place.x, place.y, place.height);
            // Close to many triangles samples scatter: to 0.4 % in the mean of 512².
            const glm::dvec3 mean = mean_of_samples(sources, 0, upward(), side == 5 ? 512 : 128);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(mean[c] / (double(emission[c]) * factor), 1.0, 0.01)
                    << side << " at " << place.height;
            if (const auto open = sources.sample(0, upward(), glm::vec2(0.5f)).open)
                EXPECT_NEAR(double(open->r) / (double(emission.r) * factor), 1.0, 1e-4);
            else
                EXPECT_EQ(side, 5);
        }
}

/// A tube's light on a wall 1 cm away is nearly all from the short part beside each point.
TEST(LightSources, LongStripsScatterLittleHoweverNearTheyAre)
{
    constexpr double kLong = 6.0;
    for (const double height : {0.01, 0.1, 1.0})
        for (const double shift : {0.0, 2.7}) {
            const Place place{{shift - 0.5 * kLong, shift + 0.5 * kLong}, {-0.01, 0.01}, height};
            for (const int side : {1, 3}) {  // few triangles, and a mesh
                const Scene scene = plate(place, side, glm::vec3(1.0f));
                const Surfaces surfaces(scene);
                const LightSources sources(scene, surfaces, float(kLong));
                const double factor = point_to_parallel_rectangle(place.x, place.y, height);
                double sum = 0.0, squares = 0.0;
                constexpr int kSide = 256;
                support::for_square(kSide, [&](const glm::vec2& at) {
                    const double light = double(sources.sample(0, upward(), at).irradiance.r);
                    sum += light / double(kSide * kSide);
                    squares += light * light / double(kSide * kSide);
                });
                EXPECT_NEAR(sum / factor, 1.0, 0.01) << side << " at " << height << ", " << shift;
                EXPECT_LT(squares, 2.0 * factor * factor) << side << " at " << height;
            }
        }
}

TEST(LightSources, APlateThatTurnsItsBackSendsNothing)
{
    Scene scene;
    support::Quad plate = support::plate_above({-1, -1}, {1, 1}, 1.0f, glm::vec3(1.0f));
    std::swap(plate.edge_u, plate.edge_v);
    support::add_quad(scene, plate);
    const Surfaces surfaces(scene);
    const LightSources sources(scene, surfaces, kExtent);
    EXPECT_EQ(mean_of_samples(sources, 0, upward()), glm::dvec3(0.0));
}

/// Parallelograms, triangles and lamps of all kinds, at random.
Scene any_lights(std::mt19937& random)
{
    std::uniform_real_distribution<float> place(-2.0f, 2.0f), angle(0.1f, 1.5f);
    const auto somewhere = [&] { return glm::vec3(place(random), place(random), place(random)); };
    Scene scene;
    for (int k = 0; k < 4; ++k) {
        support::Quad plate;
        plate.corner = somewhere();
        plate.edge_u = somewhere();
        plate.edge_v = somewhere();
        plate.emission = glm::vec3(1.0f);
        support::add_quad(scene, plate);
        Material material;
        material.emitted = glm::vec3(1.0f);
        support::add_mesh(scene, {somewhere(), somewhere(), somewhere()}, {0, 1, 2}, material);
    }
    for (int k = 0; k < 4; ++k)
        for (const auto kind : {PunctualLight::Kind::point, PunctualLight::Kind::spot,
                                PunctualLight::Kind::directional}) {
            PunctualLight light = support::make_lamp(kind, 1.0f, somewhere(), somewhere());
            light.outer_cone = angle(random);
            light.inner_cone = 0.5f * light.outer_cone;
            light.radius = kind != PunctualLight::Kind::directional && k % 2 == 1 ? 0.2f : 0.0f;
            light.angle = kind == PunctualLight::Kind::directional && k % 2 == 1 ? 0.3f : 0.0f;
            light.range = k == 2 ? 1.5f : 0.0f;
            scene.lights.push_back(light);
        }
    return scene;
}

TEST(LightSources, HaveASamplingWeightWhereverTheirLightArrives)
{
    std::mt19937 random(3);
    int without = 0, dark = 0;
    for (int n = 0; n < 200; ++n) {
        const Scene scene = any_lights(random);
        const Surfaces surfaces(scene);
        const LightSources sources(scene, surfaces, kExtent);
        const Receiver receiver = receiver_at(upward().position, upward().normal);
        for (std::size_t s = 0; s < sources.count(); ++s) {
            const bool is_lit = mean_of_samples(sources, s, upward(), 16).g > 0.0;
            const bool has_weight = sources.sampling_weight(s, receiver) > 0.0f;
            EXPECT_TRUE(has_weight || !is_lit) << "source " << s << " of scene " << n;
            dark += is_lit ? 0 : 1;
            without += has_weight ? 0 : 1;
        }
    }
    EXPECT_GT(without, dark / 2) << "half of those whose light does not arrive";
}

TEST(LightSources, HaveASamplingWeightOnLumelsAtTheRimsOfTriangles)
{
    Scene scene;
    support::add_mesh(scene, {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}},
                      {0, 1, 2}, Material());
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(-0.2f, 1.0f);
    for (int k = 0; k < 200; ++k)
        scene.lights.push_back(support::make_lamp(PunctualLight::Kind::point, 1.0f,
                                                  {place(random), place(random), place(random)}));
    const SolveScene prepared(scene, AtlasOptions{.size = 8});
    const LightSources sources(prepared.scene, prepared.surfaces, prepared.extent());
    const WorldLumels world(prepared.scene, prepared.rays, prepared.lumels);
    const RayOrigins starts(world, nullptr, false);
    int lit = 0;
    for (std::size_t i = 0; i < world.size(); ++i)
        for (std::size_t s = 0; s < sources.count(); ++s) {
            bool is_lit = false;
            support::for_square(4, [&](const glm::vec2& at) {
                const RayOrigin start = starts.start(i, at);
                is_lit |= sources.sample(s, start, at).irradiance.g > 0.0f;
            });
            lit += is_lit ? 1 : 0;
            EXPECT_TRUE(!is_lit || sources.sampling_weight(s, receiver_of(world, i)) > 0.0f);
        }
    EXPECT_GT(lit, 0);
}

TEST(LightSources, LampsSendTheirIntensityByTheSquareOfTheDistanceAndTheCosine)
{
    const glm::vec3 position(0.6f, 0.0f, 0.8f);
    for (const float radius : {0.0f, 0.2f}) {
        Scene scene;
        scene.lights = {support::make_lamp(PunctualLight::Kind::point, 5.0f, 2.0f * position)};
        scene.lights[0].radius = radius;
        const Surfaces surfaces(scene);
        const LightSources sources(scene, surfaces, kExtent);
        ASSERT_EQ(sources.count(), 1u);
        EXPECT_EQ(sources.is_small(0), radius == 0.0f);
        EXPECT_NEAR(mean_of_samples(sources, 0, upward()).g, 5.0 * 0.8 / 4.0, 1e-3) << radius;
    }
}

TEST(LightSources, ASunSendsItsLuxTimesTheCosineWhateverItsAngle)
{
    for (const float angle : {0.0f, 0.005f, 0.3f}) {
        Scene scene;
        scene.lights = {
            support::make_lamp(PunctualLight::Kind::directional, 100.0f, {}, {-0.6f, 0.0f, -0.8f})};
        scene.lights[0].angle = angle;
        const Surfaces surfaces(scene);
        const LightSources sources(scene, surfaces, kExtent);
        EXPECT_NEAR(mean_of_samples(sources, 0, upward()).g, 80.0, 0.05) << angle;
    }
}

/// Even, but for one bright texel in sixteen times thirty-two.
Sky sky_with_a_window(const glm::vec3& even, const glm::vec3& bright, int row, int column)
{
    constexpr int kWidth = 32, kHeight = 16;
    Sky sky{.width = kWidth, .height = kHeight, .radiance = {}};
    sky.radiance.assign(std::size_t(kWidth * kHeight), even);
    sky.radiance[std::size_t(row * kWidth + column)] = bright;
    return sky;
}

TEST(LightSources, ASkysBrightPartsAndTheRestAddUpToIt)
{
    for (int row = 0; row < 16; row += 5) {
        Scene scene;
        scene.sky = sky_with_a_window(glm::vec3(1.0f), glm::vec3(500.0f, 400.0f, 300.0f), row, 7);
        const Surfaces surfaces(scene);
        const LightSources sources(scene, surfaces, kExtent);
        ASSERT_EQ(sources.count(), 1u);
        const RayOrigin start = upward();
        // Both sums by the same directions: about +z, whose share of the texel may be any.
        const double whole = support::over_hemisphere([&](const glm::vec3& direction) {
            return sky_radiance(scene.sky, direction).g * direction.z;
        });
        const double dim = support::over_hemisphere(
            [&](const glm::vec3& direction) { return sources.dim_sky(direction).g * direction.z; });
        EXPECT_NEAR((mean_of_samples(sources, 0, start, 512).g + dim) / whole, 1.0, 0.01) << row;
    }
}

TEST(LightSources, AnEvenSkyHasNoBrightPart)
{
    Scene scene;
    scene.sky = support::even_sky(glm::vec3(2.0f));
    const Surfaces surfaces(scene);
    const LightSources sources(scene, surfaces, kExtent);
    EXPECT_EQ(sources.count(), 0u);
    EXPECT_EQ(sources.dim_sky({0.0f, 0.6f, 0.8f}), glm::vec3(2.0f));
}

}  // namespace
}  // namespace lumel
