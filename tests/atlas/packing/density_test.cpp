// Densities that files and options set, and how far from the content they fall.

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "shapes.h"

namespace lumel::test {
namespace {

constexpr float kGround = 200.0f;  // [m]

/// A box of 4 × 3 × 6 m, tessellated by six small boxes beside it, on the middle of a square
/// ground.
Scene house_on_a_ground()
{
    Scene scene = empty_scene();
    const int house = add_mesh(scene, {box({4.0f, 6.0f, 3.0f})}, "house");
    const int brick = add_mesh(scene, {box({0.2f, 0.1f, 0.1f})}, "brick");
    const int ground = add_mesh(scene, {quad(kGround, kGround)}, "ground");
    const glm::mat4 one(1.0f);
    add_instance(scene, house);
    for (int x = 0; x < 2; ++x)
        for (int y = 0; y < 2; ++y)
            for (int z = 0; z < 2; ++z)
                add_instance(scene, brick,
                             glm::translate(one, glm::vec3(3.8f * float(x), 5.9f * float(y),
                                                           2.9f * float(z))));
    add_instance(
        scene, ground,
        glm::translate(one, glm::vec3(2.0f - 0.5f * kGround, 3.0f - 0.5f * kGround, 0.0f)));
    return scene;
}

/// [texels/m] measured: the extent of a surface in the map over its extent in the world, for
/// surfaces that are one chart of `metres` a side.
double width_in_map(const Surface& surface)
{
    float low = 1e30f, high = -1e30f;
    for (const glm::vec2& place : surface.texcoord) {
        low = std::min(low, place.x);
        high = std::max(high, place.x);
    }
    return double(high - low);
}

/// The mean of min(1, L / d)² over the square ground by the midpoint rule, d to the rectangle that
/// the content covers.
double mean_over_ground(double half_x, double half_y, double reach)
{
    constexpr int kSteps = 2000;
    const double step = double(kGround) / kSteps;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double x = std::abs((i + 0.5) * step - 0.5 * kGround) - half_x;
            const double y = std::abs((j + 0.5) * step - 0.5 * kGround) - half_y;
            const double d = std::hypot(std::max(x, 0.0), std::max(y, 0.0));
            sum += d > reach ? reach * reach / (d * d) : 1.0;
        }
    return sum / (double(kSteps) * kSteps);
}

TEST(Density, FarGroundGetsAsMuchAsAViewerAtTheRimOfTheContentSees)
{
    const Scene scene = house_on_a_ground();
    const Atlas atlas = make_atlas(scene, {.size = 512, .coarse_afar = true});
    // The bricks span 4 × 6 × 3 m, whose middle side is 4: what is nearer than 2 m keeps all.
    const double expected = std::sqrt(mean_over_ground(2.0, 3.0, 2.0));
    const Surface& ground = atlas.surfaces.back();
    EXPECT_NEAR(width_in_map(ground) / (kGround * atlas.texels_per_metre), expected,
                0.6 / width_in_map(ground) + 0.03 * expected);  // whole texels, and the division
    EXPECT_NEAR(ground.texels_per_metre / atlas.texels_per_metre, expected, 0.03 * expected);
    EXPECT_EQ(atlas.surfaces.front().texels_per_metre, atlas.texels_per_metre);
}

TEST(Density, TheContentGetsManyTimesAsMuchAsInAnEvenMap)
{
    const Scene scene = house_on_a_ground();
    const Atlas near = make_atlas(scene, {.size = 512, .coarse_afar = true});
    const Atlas even = make_atlas(scene, {.size = 512});
    EXPECT_EQ(even.surfaces.back().texels_per_metre, even.texels_per_metre);
    EXPECT_GT(near.texels_per_metre, 4.0f * even.texels_per_metre);
}

TEST(Density, ACameraBringsWhatIsAroundItNear)
{
    Scene scene = house_on_a_ground();
    const float without =
        make_atlas(scene, {.size = 512, .coarse_afar = true}).surfaces.back().texels_per_metre /
        make_atlas(scene, {.size = 512, .coarse_afar = true}).texels_per_metre;
    scene.cameras.push_back(
        {.transform = glm::translate(glm::mat4(1.0f), glm::vec3(2.0f, 80.0f, 60.0f))});
    const Atlas atlas = make_atlas(scene, {.size = 512, .coarse_afar = true});
    EXPECT_GT(atlas.surfaces.back().texels_per_metre / atlas.texels_per_metre, 2.0f * without);
}

TEST(Density, WhatIsWithinTheViewingDistanceIsMappedEvenly)
{
    Scene scene = empty_scene();
    const int bench = add_mesh(scene, {box({1.0f, 0.5f, 0.5f})});
    for (int i = 0; i < 8; ++i)  // along two walls, as desks are
        add_instance(scene, bench,
                     glm::translate(glm::mat4(1.0f), glm::vec3(i % 2 == 0 ? 0.2f : 3.8f, 0.0f,
                                                               0.4f + 0.8f * float(i / 2))));
    add_instance(scene, add_mesh(scene, {box({5.0f, 1.5f, 4.0f})}));
    const Atlas atlas = make_atlas(scene, {.size = 256, .coarse_afar = true});
    for (const Surface& surface : atlas.surfaces)
        EXPECT_EQ(surface.texels_per_metre, atlas.texels_per_metre);
}

TEST(Density, ARuleSetsTexelsPerMetreOfWhatItsPatternNames)
{
    Scene scene = empty_scene();
    const int mesh = add_mesh(scene, {quad(2.0f, 2.0f)}, "panel");
    for (const char* name : {"wall left", "wall right", "floor"}) {
        add_instance(scene, mesh);
        scene.instances.back().name = name;
    }
    AtlasOptions options{.size = 256};
    options.densities = {{"*", 4.0f}, {"wall*", 10.0f}, {"wall right", 20.0f}};
    const Atlas atlas = make_atlas(scene, options);
    EXPECT_EQ(width_in_map(atlas.surfaces[0]), 20.0);
    EXPECT_EQ(width_in_map(atlas.surfaces[1]), 40.0);
    EXPECT_EQ(width_in_map(atlas.surfaces[2]), 8.0);
    options.densities = {{"pan?l", 5.0f}};
    EXPECT_EQ(width_in_map(make_atlas(scene, options).surfaces[1]), 10.0);
}

TEST(Density, WhatTheFileSetsHoldsAndTheRestFillsTheMap)
{
    Scene scene = empty_scene();
    const int mesh = add_mesh(scene, {quad(2.0f, 2.0f)});
    for (int i = 0; i < 3; ++i)
        add_instance(scene, mesh);
    scene.instances[1].texels_per_metre = 6.0f;
    const Atlas atlas = make_atlas(scene, {.size = 256});
    EXPECT_EQ(width_in_map(atlas.surfaces[1]), 12.0);
    EXPECT_GT(width_in_map(atlas.surfaces[0]), 100.0);
    int shared = 0;
    texel_owners(atlas, shared);
    EXPECT_EQ(shared, 0);
}

TEST(Density, RulesThatCannotFitAreRefused)
{
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {quad(2.0f, 2.0f)}, "panel"));
    AtlasOptions options{.size = 64};
    options.densities = {{"panel", 100.0f}};
    EXPECT_THROW(make_atlas(scene, options), Error);
    options.densities = {{"panel", -1.0f}};
    EXPECT_THROW(make_atlas(scene, options), Error);
}

}  // namespace
}  // namespace lumel::test
