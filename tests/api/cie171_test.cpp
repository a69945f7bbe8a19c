// Cases of CIE 171:2006 by lightmaps, computed by their equations; tests/results/measure has more
// of them, by a light meter.

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "../support/cie171.h"
#include "boxes.h"

namespace lumel::v0 {
namespace {

using namespace test;
using lumel::test::kSky12Side4;
using lumel::test::kSky16Side4;
using lumel::test::kSky5Side1;
using lumel::test::RoofOpening;

constexpr double kPoint = 0.02, kMean = 0.005;  ///< accuracy of texels and of means
constexpr float kLumen = 10'000.0f;             ///< of an isotropic lamp
constexpr float kSphere = 4.0f * std::numbers::pi_v<float>;
constexpr float kDensity = 20.0f;  ///< [1/m]
constexpr double kFine = 0.01;     ///< error relative to the light around

/// A cube of 4 m of one grey, with the lamp in its middle.
SceneContent cube(float albedo)
{
    SceneContent content =
        closed_cube({.name = "grey", .base_color = {albedo, albedo, albedo, 1.0f}});
    for (Vec3& position : content.meshes[0].primitives[0].positions)
        for (float& x : position)
            x *= 2.0f;
    content.lights = {{.name = "lamp", .intensity = kLumen / kSphere}};
    return content;
}

/// All flux arrives.
TEST(Case54, TheFluxOfALamp)
{
    const Baked baked = bake(Scene(cube(0.0f)), {.atlas = {.texels_per_metre = kDensity}});
    const double expected = double(kLumen) / 96.0;
    EXPECT_NEAR(mean_of(baked.map), expected, kMean * expected);
}

/// Of light that the faces reflect, as much as they absorb comes from the lamp:
/// mean = (Φ / A) ρ / (1 − ρ).
TEST(Case58, AllReflectionsInACube)
{
    for (const float albedo : {0.1f, 0.5f, 0.9f}) {
        const Baked baked = bake(Scene(cube(albedo)), {.atlas = {.texels_per_metre = kDensity},
                                                       .parts = Parts::indirect});
        const double expected = double(kLumen) / 96.0 * double(albedo) / (1.0 - double(albedo));
        EXPECT_NEAR(mean_of(baked.map), expected, kMean * expected) << albedo;
    }
}

constexpr float kWidth = 4.0f, kHeight = 3.0f;

void add_quad(SceneContent& content, const Vec3& corner, const Vec3& u, const Vec3& v)
{
    Primitive quad;
    for (const Vec2 at : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) {
        Vec3 position = corner;
        for (std::size_t c = 0; c < 3; ++c)
            position[c] += at[0] * u[c] + at[1] * v[c];
        quad.positions.push_back(position);
    }
    quad.indices = {0, 1, 2, 0, 2, 3};
    content.instances.push_back({.mesh = std::uint32_t(content.meshes.size())});
    content.meshes.push_back({.primitives = {quad}});
}

/// A black room: floor, wall z = 0, other walls, and a roof with an opening in its middle.
SceneContent room(float opening)
{
    SceneContent content;
    content.materials = {{.name = "black", .base_color = {0, 0, 0, 1}}};
    constexpr Vec3 x{kWidth, 0, 0}, y{0, kHeight, 0}, z{0, 0, kWidth};
    add_quad(content, {0, 0, 0}, z, x);
    add_quad(content, {0, 0, 0}, x, y);
    add_quad(content, {0, 0, kWidth}, y, x);
    add_quad(content, {0, 0, 0}, y, z);
    add_quad(content, {kWidth, 0, 0}, z, y);
    const float side = 0.5f * (kWidth - opening);
    if (side > 0.0f) {
        add_quad(content, {0, kHeight, 0}, x, {0, 0, side});
        add_quad(content, {0, kHeight, side + opening}, x, {0, 0, side});
        add_quad(content, {0, kHeight, side}, {side, 0, 0}, {0, 0, opening});
        add_quad(content, {side + opening, kHeight, side}, {side, 0, 0}, {0, 0, opening});
    }
    return content;
}

/// Light of a map at a place of a quad, 0…1 along its edges, between texels [lx].
double light_at(const Baked& baked, std::size_t surface, double u, double v)
{
    const Surface& quad = baked.surfaces.at(surface);
    std::array<Vec2, 4> corner;
    for (std::size_t i = 0; i < quad.source_vertex.size(); ++i)
        corner.at(quad.source_vertex[i]) = quad.lightmap[i];
    std::array<double, 2> at;
    for (std::size_t c = 0; c < 2; ++c)
        at[c] = double(corner[0][c]) + u * double(corner[1][c] - corner[0][c]) +
                v * double(corner[3][c] - corner[0][c]);
    const double x = at[0] * baked.map.width - 0.5, y = at[1] * baked.map.height - 0.5;
    const auto texel = [&](double column, double row) {
        return double(baked.map.rgba.at(
            4 * (std::size_t(row) * std::size_t(baked.map.width) + std::size_t(column)) + 1));
    };
    const double left = std::floor(x), top = std::floor(y), right = x - left, down = y - top;
    return (1 - down) * ((1 - right) * texel(left, top) + right * texel(left + 1, top)) +
           down * ((1 - right) * texel(left, top + 1) + right * texel(left + 1, top + 1));
}

class Case59 : public testing::TestWithParam<RoofOpening> {};

TEST_P(Case59, TheSkyThroughTheRoof)
{
    const auto& [sky, opening, expected] = GetParam();
    Scene scene(room(opening));
    // South, 60° high; its direct light does not count.
    scene.add_daylight(
        {.cie = Daylight::Cie{.type = sky,
                              .lux = 100.0f,
                              .sun = Daylight::Sun{std::numbers::pi, std::numbers::pi / 3.0}}});
    // Few rays find the small opening.
    const double error = opening < kWidth ? kFine : 0.0;
    const Baked baked = bake(scene, {.atlas = {.texels_per_metre = kDensity}, .eye_error = error});
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double found = i < 6 ? light_at(baked, 1, 0.5, (2.75 - 0.5 * double(i)) / 3.0)
                                   : light_at(baked, 0, (0.25 + 0.5 * double(i - 6)) / 4.0, 0.5);
        EXPECT_NEAR(found, expected[i], kPoint * expected[i]) << char('A' + i);
    }
}

INSTANTIATE_TEST_SUITE_P(Skies, Case59, testing::Values(kSky5Side1, kSky12Side4, kSky16Side4),
                         [](const testing::TestParamInfo<RoofOpening>& test) {
                             return name_of(test.param);
                         });

}  // namespace
}  // namespace lumel::v0
