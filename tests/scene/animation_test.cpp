// Animations: values between keys against hand-computed ones, and the contents of files.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "scene/values/animation.h"

using namespace lumel;
using namespace lumel::test;

namespace {

constexpr double kExact = 1e-12;
constexpr double kFloat = 1e-6;  // of values that files hold as floats

void expect_near(const glm::dvec3& value, const glm::dvec3& truth, double tolerance)
{
    EXPECT_NEAR(glm::distance(value, truth), 0.0, tolerance)
        << value.x << " " << value.y << " " << value.z;
}

glm::dvec4 turned_about_y(double degrees)
{
    const double half = degrees * std::numbers::pi / 360.0;
    return {0.0, std::sin(half), 0.0, std::cos(half)};
}

/// The triangle, moved by one channel with these keys.
GltfBuilder moving(const char* path, const std::vector<float>& times,
                   const std::vector<float>& values, const char* interpolation)
{
    GltfBuilder builder = one_triangle();
    const char* type = std::string(path) == "rotation" ? "VEC4" : "VEC3";
    const std::size_t components = std::string(path) == "rotation" ? 4 : 3;
    const int input = builder.add_accessor(times, "SCALAR", 5126, times.size());
    const int output = builder.add_accessor(values, type, 5126, values.size() / components);
    builder.push(
        "animations",
        {{"name", "play"},
         {"samplers",
          Json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}})},
         {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}})}});
    return builder;
}

GltfBuilder sliding()
{
    return moving("translation", {0, 1}, {0, 0, 0, 2, 0, 0}, "LINEAR");
}

Animation read(const GltfBuilder& builder, std::size_t index = 0)
{
    const TempFolder folder;
    return read_animation(builder.write(folder), index);
}

std::string animation_error(const GltfBuilder& builder, std::size_t index = 0)
{
    try {
        read(builder, index);
    } catch (const Error& error) {
        return error.kind() == ErrorKind::input ? error.what() : "";
    }
    return "";
}

/// An emissive first material and a channel that a pointer aims at it.
GltfBuilder shining(const char* pointer, const char* type, const std::vector<float>& values)
{
    GltfBuilder builder = one_triangle();
    builder.push(
        "materials",
        {{"emissiveFactor", {1, 0.5, 0}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 10}}}}}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    const std::vector<float> times = {0, 2};
    const int input = builder.add_accessor(times, "SCALAR", 5126, 2);
    const int output = builder.add_accessor(values, type, 5126, 2);
    const Json target = {{"path", "pointer"},
                         {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
    builder.push("animations", {{"samplers", Json::array({{{"input", input}, {"output", output}}})},
                                {"channels", Json::array({{{"sampler", 0}, {"target", target}}})}});
    return builder;
}

constexpr const char* kStrengthPointer =
    "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength";

}  // namespace

TEST(Animations, StepsHoldTheKeyBefore)
{
    const Track track{Interpolation::step, {1.0, 2.0}, {glm::dvec4(3), glm::dvec4(5)}};
    EXPECT_EQ(value_at(track, 0.0).x, 3.0);
    EXPECT_EQ(value_at(track, 1.999).x, 3.0);
    EXPECT_EQ(value_at(track, 2.0).x, 5.0);
    EXPECT_EQ(value_at(track, 9.0).x, 5.0);
}

TEST(Animations, LinearIsStraightAndHoldsItsEnds)
{
    const Track track{Interpolation::linear, {1.0, 3.0}, {{0, 2, 4, 0}, {8, 2, 0, 0}}};
    expect_near(value_at(track, 0.0), {0, 2, 4}, 0.0);
    expect_near(value_at(track, 1.5), {2, 2, 3}, kExact);
    expect_near(value_at(track, 3.0), {8, 2, 0}, 0.0);
    expect_near(value_at(track, 4.0), {8, 2, 0}, 0.0);
}

TEST(Animations, RotationsTurnEvenlyAlongTheShorterArc)
{
    const glm::dvec4 quarter = turned_about_y(90.0);
    for (const glm::dvec4& end : {quarter, -quarter}) {
        const Track track{Interpolation::linear, {0.0, 3.0}, {turned_about_y(0.0), end}};
        const glm::dvec3 x = rotation_at(track, 1.0) * glm::dvec3(1, 0, 0);
        expect_near(x, {std::cos(std::numbers::pi / 6), 0, -std::sin(std::numbers::pi / 6)},
                    kExact);
    }
}

TEST(Animations, SplinesAreHermites)
{
    // From 1 to 2 over 2 s, leaving with slope 3 and arriving with slope -1: in the middle
    // (1 + 2) / 2 + 2 (3 - (-1)) / 8; at a quarter 27/32 + 2 · 9/64 · 3 + 10/32 + 2 · 3/64.
    const Track track{Interpolation::cubic_spline,
                      {0.0, 2.0},
                      {glm::dvec4(7), glm::dvec4(1), glm::dvec4(3), glm::dvec4(-1), glm::dvec4(2),
                       glm::dvec4(7)}};
    EXPECT_NEAR(value_at(track, 1.0).x, 2.5, kExact);
    EXPECT_NEAR(value_at(track, 0.5).x, 27.0 / 32 + 27.0 / 32 + 10.0 / 32 + 3.0 / 32, kExact);
    EXPECT_EQ(value_at(track, 0.0).x, 1.0);
    EXPECT_EQ(value_at(track, 5.0).x, 2.0);
}

TEST(Animations, SplinesOfRotationsStayRotations)
{
    const Track track{Interpolation::cubic_spline,
                      {0.0, 1.0},
                      {glm::dvec4(0), turned_about_y(0.0), glm::dvec4(0), glm::dvec4(0),
                       turned_about_y(90.0), glm::dvec4(0)}};
    const glm::dquat half = rotation_at(track, 0.5);
    EXPECT_NEAR(glm::length(half), 1.0, kExact);
    // Between slopes of 0 the middle is the mean, whose direction is half the turn.
    const double root = std::sqrt(0.5);
    expect_near(half * glm::dvec3(1, 0, 0), {root, 0, -root}, kExact);
}

TEST(Animations, ANodeMovesAllThatIsBelowIt)
{
    GltfBuilder builder = sliding();
    builder.push("nodes", {{"mesh", 0}, {"name", "still"}});
    builder.push("nodes", {{"mesh", 0}, {"name", "child"}, {"translation", {0, 1, 0}}});
    builder.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}}}});
    builder.push("nodes", {{"camera", 0}});
    builder.json["nodes"][0]["children"] = {2, 3};
    builder.json["scenes"][0]["nodes"] = {0, 1};
    const Animation animation = read(builder);
    EXPECT_EQ(animation.name, "play");
    EXPECT_EQ(animation.duration, 1.0);
    Scene scene = builder.read();
    EXPECT_EQ(movers_of(animation, scene), (std::vector<std::uint32_t>{0, 2}));
    pose(scene, animation, 0.25);
    expect_near(glm::vec3(scene.instances[0].transform[3]), {0.5, 0, 0}, kFloat);
    expect_near(glm::vec3(scene.instances[1].transform[3]), {0, 0, 0}, 0.0);
    expect_near(glm::vec3(scene.instances[2].transform[3]), {0.5, 1, 0}, kFloat);
    expect_near(glm::vec3(scene.cameras[0].transform[3]), {0.5, 0, 0}, kFloat);
}

TEST(Animations, NormalizedRotationsAreRead)
{
    GltfBuilder builder = sliding();
    const std::vector<std::int16_t> turns = {0, 0, 0, 32767, 0, 23170, 0, 23170};
    builder.json["animations"][0]["samplers"][0]["output"] =
        builder.add_accessor(turns, "VEC4", 5122, 2, true);
    builder.json["animations"][0]["channels"][0]["target"]["path"] = "rotation";
    const glm::dmat4 quarter = transform_at(read(builder), 0, 1.0);
    expect_near(glm::dvec3(quarter[0]), {0, 0, -1}, 1e-4);
}

TEST(Animations, EmissionFollowsPointers)
{
    const GltfBuilder builder = shining(kStrengthPointer, "SCALAR", {0, 20});
    const Animation animation = read(builder);
    ASSERT_EQ(animation.materials.size(), 1u);
    expect_near(emitted_at(animation.materials[0], 0.5), {5, 2.5, 0}, kFloat);
    expect_near(most_emitted(animation.materials[0]), {20, 10, 0}, kFloat);
    Scene scene = builder.read();
    pose(scene, animation, 2.0);
    expect_near(scene.materials[0].emitted, {20, 10, 0}, kFloat);

    const Animation colour =
        read(shining("/materials/0/emissiveFactor", "VEC3", {0, 0, 0, 0, 0.5, 1}));
    expect_near(emitted_at(colour.materials.at(0), 1.0), {0, 2.5, 5}, kFloat);
}

TEST(Animations, OtherTargetsAreLeftOutWithOneWarning)
{
    for (const char* pointer :
         {"/materials/0/alphaCutoff", "/materials/x/emissiveFactor", "/cameras/0/yfov"}) {
        const Animation animation = read(shining(pointer, "SCALAR", {0, 1}));
        EXPECT_TRUE(animation.materials.empty());
        ASSERT_EQ(animation.warnings.size(), 1u);
        EXPECT_TRUE(contains(animation.warnings[0], "1 channel of the animation left out"));
    }
}

TEST(Animations, WhatMakesNoSenseIsAnError)
{
    EXPECT_TRUE(contains(animation_error(one_triangle()), "has no animation"));
    EXPECT_TRUE(contains(animation_error(sliding(), 1), "its animations are 0 to 0"));
    EXPECT_TRUE(
        contains(animation_error(moving("translation", {0, 0}, {0, 0, 0, 1, 0, 0}, "LINEAR")),
                 "/animations/0/samplers/0/input: has times that do not rise at key 1"));
    EXPECT_TRUE(
        contains(animation_error(moving("translation", {-1}, {0, 0, 0}, "STEP")), "negative"));
    EXPECT_TRUE(
        contains(animation_error(moving("translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "CUBICSPLINE")),
                 "/samplers/0/output: has 2 values, but its keys need 6"));
    EXPECT_TRUE(
        contains(animation_error(moving("translation", {0, 1}, {0, 0, 0, NAN, 0, 0}, "LINEAR")),
                 "not finite"));
    EXPECT_TRUE(contains(animation_error(moving("rotation", {0}, {0, 0, 0, 2}, "LINEAR")),
                         "not a unit quaternion at key 0"));
    EXPECT_TRUE(contains(animation_error(moving("scale", {0}, {1, 1, 1}, "SLOW")), "\"SLOW\""));
    EXPECT_TRUE(contains(animation_error(shining(kStrengthPointer, "SCALAR", {0, -1})),
                         "negative amount of light at key 1"));
    EXPECT_TRUE(contains(
        animation_error(shining("/materials/3/emissiveFactor", "VEC3", {0, 0, 0, 1, 1, 1})),
        "has 1 materials"));

    GltfBuilder twice = sliding();
    twice.json["animations"][0]["channels"].push_back(twice.json["animations"][0]["channels"][0]);
    EXPECT_TRUE(
        contains(animation_error(twice), "/channels/1/target: is the target of an earlier"));

    GltfBuilder fixed = sliding();
    fixed.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_TRUE(contains(animation_error(fixed), "has a matrix"));

    GltfBuilder kind = sliding();
    kind.json["animations"][0]["channels"][0]["target"]["path"] = "rotation";
    EXPECT_TRUE(contains(animation_error(kind), "an accessor of VEC3, but needs VEC4"));
}
