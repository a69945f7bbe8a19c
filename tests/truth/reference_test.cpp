// The path tracer against rooms and plates whose light is known.

#include "truth/reference.h"

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "../support/box_lumels.h"
#include "../support/closed_forms.h"
#include "../support/welch.h"

namespace lumel {
namespace {

using namespace support;

std::vector<glm::vec3> solve(const HandMade& made, int samples, SampleRule rule = SampleRule::area,
                             std::uint32_t seed = 1)
{
    const RayScene rays(made.scene);
    ReferenceOptions options;
    options.samples_per_lumel = samples;
    options.rule = rule;
    options.seed = seed;
    return reference_irradiance(made.scene, rays, made.lumels, options);
}

/// A closed cube seen from inside, everything of one albedo and emission.
HandMade furnace(float albedo, float emission)
{
    Quad look;
    look.albedo = glm::vec3(albedo);
    look.emission = glm::vec3(emission);
    look.res_u = look.res_v = 8;
    const auto walls = box_walls(glm::vec3(-1.0f), glm::vec3(1.0f), true, look);
    return make_quads({walls.begin(), walls.end()});
}

void expect_furnace(float albedo, int samples, double mean_tolerance, double lumel_tolerance)
{
    const double truth = furnace_irradiance(1.0, albedo);
    double mean = 0.0;
    const HandMade made = furnace(albedo, 1.0f);
    const auto irradiance = solve(made, samples);
    for (const glm::vec3& H : irradiance) {
        mean += H.x / double(irradiance.size());
        EXPECT_NEAR(H.x / truth, 1.0, lumel_tolerance);
        EXPECT_EQ(H.x, H.y);
    }
    EXPECT_NEAR(mean / truth, 1.0, mean_tolerance);
}

TEST(Reference, AFurnaceOfAlbedoOneHalfDoublesItsEmission)
{
    expect_furnace(0.5f, 512, 0.004, 0.1);
}

TEST(Reference, AFurnaceOfAlbedoNineTenthsMultipliesItsEmissionByTen)
{
    expect_furnace(0.9f, 256, 0.01, 0.2);
}

/// Two quads, the first lights and the second receives.
HandMade plates(const Quad& receiver_place, int side)
{
    Quad lamp;
    lamp.albedo = glm::vec3(0.0f);
    lamp.emission = glm::vec3(2.0f, 4.0f, 8.0f);
    Quad receiver = receiver_place;
    receiver.albedo = glm::vec3(0.0f);
    receiver.res_u = receiver.res_v = side;
    return make_quads({lamp, receiver});
}

/// Relative RMSE of the second quad's H against E × form factor at each centre.
template <typename FormFactor>
double plate_error(const HandMade& made, const std::vector<glm::vec3>& irradiance, FormFactor F)
{
    double squares = 0.0, sum = 0.0;
    for (std::size_t i = made.first[1]; i < made.first[2]; ++i) {
        const glm::dvec3 truth = glm::dvec3(2.0, 4.0, 8.0) * F(made.lumels.lumels[i].position);
        const glm::dvec3 d = glm::dvec3(irradiance[i]) - truth;
        squares += glm::dot(d, d) / 3.0;
        sum += (truth.x + truth.y + truth.z) / 3.0;
    }
    const double count = double(made.first[2] - made.first[1]);
    return std::sqrt(squares / count) / (sum / count);
}

TEST(Reference, FacingPlatesMatchTheFormFactorAtEveryPoint)
{
    const HandMade made = plates({{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}, 16);
    const auto form_factor = [](const glm::dvec3& at) {
        return point_to_parallel_rectangle({-at.x, 1 - at.x}, {-at.y, 1 - at.y}, 1.0);
    };
    EXPECT_LT(plate_error(made, solve(made, 256, SampleRule::centre), form_factor), 0.005);
    EXPECT_LT(plate_error(made, solve(made, 256), form_factor), 0.01);
}

TEST(Reference, PlatesAtARightAngleMatchTheFormFactorAtEveryPoint)
{
    // The receiver stands on the lamp's edge y = 0 and faces it.
    const HandMade made = plates({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, 16);
    const auto form_factor = [](const glm::dvec3& at) {
        return point_to_perpendicular_rectangle({-at.x, 1 - at.x}, {0, 1}, at.z);
    };
    EXPECT_LT(plate_error(made, solve(made, 1024, SampleRule::centre), form_factor), 0.005);
}

TEST(Reference, ALampOfANanometreLightsAsAPointDoes)
{
    constexpr float kSide = 1e-9f, kHeight = 10.0f;
    Quad lamp{{}, {0, kSide, 0}, {kSide, 0, 0}};
    lamp.emission = glm::vec3(100.0f / (kSide * kSide));  // 100 lm
    Quad receiver{{-0.5f, -0.5f, -kHeight}};
    const double truth = 100.0 / (std::numbers::pi * kHeight * kHeight);
    const auto irradiance = solve(make_quads({lamp, receiver}), 16, SampleRule::centre);
    EXPECT_NEAR(double(irradiance[1].g), truth, 1e-4 * truth);
}

TEST(Reference, LightIsTheSameHoweverTheSceneIsPlaced)
{
    // Both plates moved, turned, scaled and mirrored: geometry, not coordinates, decides.
    const HandMade upright = plates({{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}, 4);
    const auto expected = solve(upright, 256);
    glm::mat4 place = glm::translate(glm::mat4(1.0f), {100.0f, -50.0f, 30.0f});
    place = glm::rotate(place, 1.0f, {0.3f, 0.5f, 0.8f});
    for (const float mirror : {1.0f, -1.0f}) {
        HandMade moved = upright;
        for (Instance& instance : moved.scene.instances)
            instance.transform = glm::scale(place, glm::vec3(mirror * 3.0f, 3.0f, 3.0f));
        const auto irradiance = solve(moved, 256);
        for (std::size_t i = moved.first[1]; i < moved.first[2]; ++i)
            EXPECT_NEAR(irradiance[i].x, expected[i].x, 0.01f * expected[i].x);
    }
}

TEST(Reference, BacksOfSingleSidedSurfacesNeitherEmitNorReflect)
{
    // The lamp faces away from the receiver; when double-sided it shines on it.
    HandMade made = plates({{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}, 2);
    const auto irradiance = solve(made, 64);
    for (std::size_t i = made.first[1]; i < made.first[2]; ++i)
        EXPECT_EQ(irradiance[i], glm::vec3(0.0f));
    made.scene.materials[0].double_sided = true;
    EXPECT_LT(plate_error(
                  made, solve(made, 256, SampleRule::centre),
                  [](const glm::dvec3& at) {
                      return point_to_parallel_rectangle({-at.x, 1 - at.x}, {-at.y, 1 - at.y}, 1.0);
                  }),
              0.01);
}

TEST(Reference, NoLightEntersASealedBox)
{
    // Turned, so that walls meet at coordinates that do not round alike.
    Quad look;
    look.albedo = glm::vec3(0.9f);
    look.res_u = look.res_v = 6;
    auto walls = box_walls(glm::vec3(0.0f), glm::vec3(1.0f, 0.7f, 1.3f), true, look);
    Quad lamp;
    lamp.corner = {-3.0f, -3.0f, -0.01f};
    lamp.edge_u = {6.0f, 0.0f, 0.0f};
    lamp.edge_v = {0.0f, 6.0f, 0.0f};
    lamp.emission = glm::vec3(1e6f);
    lamp.double_sided = true;
    std::vector<Quad> quads(walls.begin(), walls.end());
    quads.push_back(lamp);
    HandMade made = make_quads(quads);
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), 0.7f, {0.2f, 0.9f, 0.4f});
    for (Instance& instance : made.scene.instances)
        instance.transform = turn;
    const auto irradiance = solve(made, 1024);
    for (std::size_t i = 0; i < made.first[6]; ++i)
        ASSERT_EQ(irradiance[i], glm::vec3(0.0f)) << "lumel " << i;
    EXPECT_GE(irradiance[made.first[6]].x, 0.0f);
}

/// A room with a small lamp, a block's worth of colour and one dark wall.
HandMade lamp_room(float emission)
{
    Quad look;
    look.res_u = look.res_v = 5;
    look.albedo = glm::vec3(0.7f, 0.5f, 0.3f);
    auto walls = box_walls(glm::vec3(0.0f), glm::vec3(2.0f), true, look);
    walls[0].albedo = glm::vec3(0.05f);
    std::vector<Quad> quads(walls.begin(), walls.end());
    Quad lamp;
    lamp.corner = {0.8f, 1.9f, 0.8f};
    lamp.edge_u = {0.4f, 0.0f, 0.0f};
    lamp.edge_v = {0.0f, 0.0f, 0.4f};
    lamp.emission = glm::vec3(emission, 0.5f * emission, 0.0f);
    quads.push_back(lamp);
    Quad shade = lamp;  // a plate that casts a shadow
    shade.corner.y = 1.0f;
    shade.emission = glm::vec3(0.0f);
    shade.double_sided = true;
    quads.push_back(shade);
    return make_quads(quads);
}

TEST(Reference, LightIsLinearInEmission)
{
    const auto once = solve(lamp_room(1.0f), 32);
    const auto fourfold = solve(lamp_room(4.0f), 32);
    for (std::size_t i = 0; i < once.size(); ++i) {
        EXPECT_FLOAT_EQ(fourfold[i].x, 4.0f * once[i].x);
        EXPECT_FLOAT_EQ(fourfold[i].y, 4.0f * once[i].y);
        EXPECT_EQ(once[i].z, 0.0f);
    }
}

TEST(Reference, OneSeedGivesTheSameBytesAndAnotherSeedOthers)
{
    const HandMade made = lamp_room(1.0f);
    const auto first = solve(made, 8);
    EXPECT_EQ(first, solve(made, 8));
    EXPECT_NE(first, solve(made, 8, SampleRule::area, 2));
}

TEST(Reference, SeedsAgreeWithinTheirNoise)
{
    const HandMade made = lamp_room(1.0f);
    const std::vector<double> t = support::welch_t([&](int group, std::uint32_t seed) {
        // The groups take different numbers of samples, which an unbiased mean ignores.
        return solve(made, group == 0 ? 64 : 12, SampleRule::area, seed);
    });
    for (std::size_t i = 0; i < t.size(); ++i)
        EXPECT_LT(std::abs(t[i]), 8.0) << "lumel " << i;
    const double squares = support::mean_square(t);
    EXPECT_GT(squares, 0.8);
    EXPECT_LT(squares, 1.6);
}

TEST(Reference, TheCentreRuleIgnoresTheLumelsExtent)
{
    // One lumel over the whole plate: its centre sees more of the lamp than its area does.
    const HandMade made = plates({{0, 0, 0.5f}, {0, 1, 0}, {1, 0, 0}}, 1);
    const double centre = point_to_parallel_rectangle({-0.5, 0.5}, {-0.5, 0.5}, 0.5);
    EXPECT_NEAR(solve(made, 4096, SampleRule::centre)[1].x, 2.0 * centre, 0.003);
    EXPECT_NEAR(solve(made, 4096)[1].x, 2.0 * opposed_rectangles(1, 1, 0.5), 0.003);
}

TEST(Reference, TexturedLampsShineWhereTheirTextureDoes)
{
    // Only the half x > 0.5 of the lamp emits.
    HandMade made = plates({{0, 0, 0.5f}, {0, 1, 0}, {1, 0, 0}}, 6);
    Texture half{256, 1, {}};
    for (int x = 0; x < half.width; ++x)
        half.rgba.insert(half.rgba.end(), 4, x < half.width / 2 ? 0 : 255);
    made.scene.textures.push_back(half);
    made.scene.materials[0].emissive_texture.texture = 0;
    made.scene.materials[0].emissive_texture.wrap_s = Wrap::clamp;
    const auto form_factor = [](const glm::dvec3& at) {
        return point_to_parallel_rectangle({0.5 - at.x, 1 - at.x}, {-at.y, 1 - at.y}, 0.5);
    };
    EXPECT_LT(plate_error(made, solve(made, 512, SampleRule::centre), form_factor), 0.01);
}

TEST(Reference, ABlendedPlateLetsThroughWhatItsAlphaLeaves)
{
    Quad lamp;
    lamp.emission = glm::vec3(1.0f);
    lamp.albedo = glm::vec3(0.0f);
    Quad veil;
    veil.corner = {-5.0f, -5.0f, 0.5f};
    veil.edge_u = {10.0f, 0.0f, 0.0f};
    veil.edge_v = {0.0f, 10.0f, 0.0f};
    veil.albedo = glm::vec3(0.0f);
    Quad receiver{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    receiver.albedo = glm::vec3(0.0f);
    HandMade made = make_quads({lamp, veil, receiver});
    made.scene.materials[1].alpha_mode = AlphaMode::blend;
    made.scene.materials[1].base_color.a = 0.25f;
    EXPECT_NEAR(solve(made, 16384)[2].x, 0.75 * opposed_rectangles(1, 1, 1), 0.002);
}

TEST(Reference, BuriedLumelsStayBlack)
{
    HandMade made = furnace(0.5f, 1.0f);
    made.lumels.lumels[3].flags = kLumelBuried;
    const auto irradiance = solve(made, 4);
    EXPECT_EQ(irradiance[3], glm::vec3(0.0f));
    EXPECT_GT(irradiance[4].x, 0.0f);
}

TEST(Reference, AStoppedRunKeepsWhatItHas)
{
    const HandMade made = furnace(0.5f, 1.0f);
    const RayScene rays(made.scene);
    ReferenceOptions options;
    options.samples_per_lumel = 1 << 20;
    double before = 0.0;
    int reports = 0;
    const auto irradiance =
        reference_irradiance(made.scene, rays, made.lumels, options, [&](double done) {
            EXPECT_GT(done, before);
            before = done;
            return ++reports < 3;
        });
    EXPECT_EQ(reports, 3);
    for (const glm::vec3& H : irradiance)
        EXPECT_NEAR(H.x, 2.0f, 0.6f);
}

TEST(Reference, ARunThatStopsBeforeAllLumelsHaveASampleHasNothing)
{
    HandMade made = furnace(0.5f, 1.0f);
    made.lumels.lumels.resize(20000, made.lumels.lumels.front());
    EXPECT_TRUE(reference_irradiance(made.scene, RayScene(made.scene), made.lumels, {}, [](double) {
                    return false;
                }).empty());
}

TEST(Reference, ADarkSceneIsBlack)
{
    for (const glm::vec3& H : solve(furnace(0.5f, 0.0f), 4))
        EXPECT_EQ(H, glm::vec3(0.0f));
}

}  // namespace
}  // namespace lumel
