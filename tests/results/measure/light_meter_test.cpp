// What a light meter shows, against closed forms. Form factors are those of [How], written here.

#include <cmath>

#include <gtest/gtest.h>

#include "../../support/lamps.h"
#include "meter.h"

using namespace lumel;
using namespace lumel::test;
using support::Quad;

namespace {

void expect_within(const Reading& reading, double lux)
{
    EXPECT_NEAR(reading.lux, lux, kAccuracy * lux) << "stated noise " << reading.noise;
    EXPECT_LT(reading.noise, kAccuracy * lux);
    EXPECT_FALSE(reading.inside);
}

/// A black disc of 48 sides in the plane y = height that faces down and emits E [lm/m²].
void add_disc_lamp(Scene& scene, double radius, double height, float emission)
{
    constexpr int kSides = 48;
    // The polygon has the area of the disc.
    const double corner = radius * std::sqrt(2.0 * kPi / (kSides * std::sin(2.0 * kPi / kSides)));
    std::vector<glm::vec3> positions = {{0.0f, float(height), 0.0f}};
    std::vector<std::uint32_t> indices;
    for (int i = 0; i < kSides; ++i) {
        const double angle = 2.0 * kPi * i / kSides;
        positions.emplace_back(corner * std::cos(angle), height, corner * std::sin(angle));
        indices.insert(indices.end(),
                       {0, std::uint32_t(i + 1), std::uint32_t((i + 1) % kSides + 1)});
    }
    Material material;
    material.base_color = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    material.emitted = glm::vec3(emission / float(kPi));
    support::add_mesh(scene, positions, indices, material);
}

/// Form factor of a rectangle a × b at distance c, parallel, one corner above the point. B-3 of
/// [How]
double corner_factor(double a, double b, double c)
{
    const double x = a / c, y = b / c, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
    return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * kPi);
}

/// One of a scene's own floors, far below and black: rays have something to be measured against.
Quad black_floor()
{
    return {.corner = {-2.0f, 0.0f, 2.0f},
            .edge_u = {4.0f, 0.0f, 0.0f},
            .edge_v = {0.0f, 0.0f, -4.0f},
            .albedo = glm::vec3(0.0f)};
}

}  // namespace

TEST(LightMeter, UnderADiscGetsItsEmissionTimesTheFormFactor)
{
    const double radius = 0.5, distance = 1.2;
    const MeteredRoom room({black_floor()}, 0.0f, [&](Scene& scene) {
        add_disc_lamp(scene, radius, 0.8 + distance, 1000.0f);
    });
    const double factor = radius * radius / (radius * radius + distance * distance);
    expect_within(room.read({{0.0f, 0.8f, 0.0f}}), 1000.0 * factor);
}

// A ceiling of albedo 0.5, lit by one lamp to a quarter, is the light of both above the panels.
TEST(LightMeter, ReadsLampsApart)
{
    const Quad small = panel({-0.3f, 2.5f, -0.2f}, 1.0f, 0.7f, 0.0f, 2000.0f);
    const Quad far = panel({-1.5f, 2.4f, -0.2f}, 0.5f, 0.5f, 0.0f, 3000.0f);
    const Quad ceiling = panel({-40.0f, 3.0f, -40.0f}, 80.0f, 80.0f, 0.5f);
    const MeteredRoom room({black_floor(), small, far, ceiling}, 400.0f, kNothingElse);
    const MeterPoint point{{0.0f, 0.8f, 0.0f}};
    const double of_small = corner_factor(0.7, 0.5, 1.7) + corner_factor(0.3, 0.5, 1.7) +
                            corner_factor(0.7, 0.2, 1.7) + corner_factor(0.3, 0.2, 1.7);
    const double of_far = corner_factor(1.5, 0.3, 1.6) - corner_factor(1.0, 0.3, 1.6) +
                          corner_factor(1.5, 0.2, 1.6) - corner_factor(1.0, 0.2, 1.6);
    const double seen = 4.0 * corner_factor(40.0, 40.0, 2.2) - of_small - of_far;
    const std::vector<double> lamps = room.read_lamps(point, {0.25f, 0.75f});
    ASSERT_EQ(lamps.size(), 2u);
    const double reflected = 0.5 * 400.0 * seen;
    EXPECT_NEAR(lamps[0], 2000.0 * of_small + 0.25 * reflected, kAccuracy * lamps[0]);
    EXPECT_NEAR(lamps[1], 3000.0 * of_far + 0.75 * reflected, kAccuracy * lamps[1]);
    const double all = room.read(point).lux;
    EXPECT_NEAR(lamps[0] + lamps[1], all, 1e-6 * all);
}

TEST(LightMeter, UnderARectangleGetsItsEmissionTimesTheFormFactor)
{
    const Quad lamp = panel({-0.3f, 2.5f, -0.2f}, 1.0f, 0.7f, 0.0f, 2000.0f);
    const MeteredRoom room({black_floor(), lamp}, 0.0f, kNothingElse);
    const double factor = corner_factor(0.7, 0.5, 1.7) + corner_factor(0.3, 0.5, 1.7) +
                          corner_factor(0.7, 0.2, 1.7) + corner_factor(0.3, 0.2, 1.7);
    expect_within(room.read({{0.0f, 0.8f, 0.0f}}), 2000.0 * factor);
}

TEST(LightMeter, HalfOfARectangleBehindAScreenGivesTheOtherHalf)
{
    const Quad lamp = panel({-0.5f, 2.0f, -0.5f}, 1.0f, 1.0f, 0.0f, 1000.0f);
    const Quad screen{.corner = {0.0f, 1.5f, -3.0f},
                      .edge_u = {3.0f, 0.0f, 0.0f},
                      .edge_v = {0.0f, 0.0f, 6.0f},
                      .albedo = glm::vec3(0.0f),
                      .double_sided = true};
    const MeteredRoom room({lamp, screen}, 0.0f, kNothingElse);
    expect_within(room.read({{0.0f, 1.0f, 0.0f}}), 1000.0 * 2.0 * corner_factor(0.5, 0.5, 1.0));
}

TEST(LightMeter, APointLampGivesItsIntensityTimesTheCosineOverTheSquareOfTheDistance)
{
    const glm::vec3 lamp(0.6f, 2.0f, -0.4f), point(-0.2f, 0.7f, 0.3f);
    const MeteredRoom room({black_floor()}, 0.0f, [&](Scene& scene) {
        scene.lights = {support::make_lamp(PunctualLight::Kind::point, 900.0f, lamp)};
    });
    const glm::dvec3 to = glm::dvec3(lamp) - glm::dvec3(point);
    const double squared = glm::dot(to, to);
    expect_within(room.read({point}), 900.0 * (to.y / std::sqrt(squared)) / squared);
    const glm::vec3 tilted = glm::normalize(glm::vec3(1.0f, 2.0f, -0.5f));
    expect_within(room.read({point, tilted}),
                  900.0 * glm::dot(to, glm::dvec3(tilted)) / (std::sqrt(squared) * squared));
    EXPECT_EQ(room.read({point, {0.0f, -1.0f, 0.0f}}).lux, 0.0);
}

TEST(LightMeter, ManyPointLampsAddUp)
{
    // More than have rays of their own.
    constexpr int kSide = 40;
    const glm::vec3 point(0.1f, 0.5f, 0.2f);
    double lux = 0.0;
    const MeteredRoom room({black_floor()}, 0.0f, [&](Scene& scene) {
        for (int i = 0; i < kSide * kSide; ++i) {
            const glm::vec3 at(0.2f * float(i % kSide) - 4.0f, 3.0f,
                               0.2f * float(i / kSide) - 4.0f);
            scene.lights.push_back(support::make_lamp(PunctualLight::Kind::point, 1.0f, at));
            const glm::dvec3 to = glm::dvec3(at) - glm::dvec3(point);
            lux += to.y / std::pow(glm::dot(to, to), 1.5);
        }
    });
    expect_within(room.read({point}), lux);
}

TEST(LightMeter, InAFurnaceGetsTheEmissionOverOneMinusTheAlbedoWhateverItFaces)
{
    const float albedo = 0.7f, emission = 300.0f, arriving = emission / (1.0f - albedo);
    const auto walls = support::box_walls(
        {0.0f, 0.0f, 0.0f}, {3.0f, 2.5f, 4.0f}, true,
        {.albedo = glm::vec3(albedo), .emission = glm::vec3(emission), .res_u = 4, .res_v = 4});
    const MeteredRoom room({walls.begin(), walls.end()}, arriving, kNothingElse);
    for (const glm::vec3& normal : {glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(1.0f, 0.0f, 0.0f),
                                    glm::normalize(glm::vec3(-1.0f, -2.0f, 3.0f))})
        expect_within(room.read({{1.0f, 0.8f, 1.5f}, normal}), double(arriving));
    // On a surface too.
    expect_within(room.read({{1.0f, 0.0f, 1.5f}}), double(arriving));
}

TEST(LightMeter, ReflectedLightIsTheAlbedoTimesTheIrradianceOfWhatIsMet)
{
    // A wall of one radiosity is a lamp that emits as much.
    Quad ceiling = panel({-0.5f, 2.0f, -0.5f}, 1.0f, 1.0f, 0.4f);
    ceiling.res_u = ceiling.res_v = 3;
    const MeteredRoom room({ceiling}, 500.0f, kNothingElse);
    expect_within(room.read({{0.0f, 1.0f, 0.0f}}),
                  0.4 * 500.0 * 4.0 * corner_factor(0.5, 0.5, 1.0));
}

TEST(LightMeter, TheStatedNoiseIsThatOfReadingsWithOtherSeeds)
{
    const Quad ceiling = panel({-0.5f, 2.0f, -0.5f}, 1.0f, 1.0f, 0.4f);
    const MeteredRoom room({ceiling}, 500.0f, kNothingElse);
    constexpr int kReadings = 200;
    double sum = 0.0, squares = 0.0, stated = 0.0;
    for (int i = 0; i < kReadings; ++i) {
        const Reading reading = room.read({{0.1f, 1.0f, 0.2f}}, 256, std::uint32_t(i));
        sum += reading.lux;
        squares += reading.lux * reading.lux;
        stated += reading.noise * reading.noise;
    }
    const double spread = std::sqrt(squares / kReadings - sum * sum / kReadings / kReadings);
    // Of 200 values the spread is known to 5 %; three times that.
    EXPECT_NEAR(std::sqrt(stated / kReadings) / spread, 1.0, 0.15);
}

TEST(LightMeter, APointInsideOfAClosedBoxIsSaidToBeInside)
{
    const auto block = support::box_walls({-0.5f, 0.0f, -0.5f}, {0.5f, 1.0f, 0.5f}, false);
    const MeteredRoom room({block.begin(), block.end()}, 100.0f, kNothingElse);
    EXPECT_TRUE(room.read({{0.0f, 0.5f, 0.0f}}).inside);
    EXPECT_FALSE(room.read({{0.0f, 1.5f, 0.0f}}).inside);
    EXPECT_FALSE(room.read({{0.6f, 0.5f, 0.0f}}).inside);
}

// As Blender exports rooms: each wall a box of two-sided faces, its outside as dark as its inside.
TEST(LightMeter, APointInsideOfATwoSidedWallIsSaidToBeInside)
{
    std::vector<Quad> faces;
    const auto add_wall = [&](const glm::vec3& low, const glm::vec3& high) {
        for (const Quad& face : support::box_walls(low, high, false, {.double_sided = true}))
            faces.push_back(face);
    };
    add_wall({-0.2f, -0.2f, -0.2f}, {4.2f, 0.0f, 4.2f});
    add_wall({-0.2f, 3.0f, -0.2f}, {4.2f, 3.2f, 4.2f});
    add_wall({-0.2f, 0.0f, 0.0f}, {0.0f, 3.0f, 4.0f});
    add_wall({4.0f, 0.0f, 0.0f}, {4.2f, 3.0f, 4.0f});
    add_wall({-0.2f, 0.0f, -0.2f}, {4.2f, 3.0f, 0.0f});
    add_wall({-0.2f, 0.0f, 4.0f}, {4.2f, 3.0f, 4.2f});
    const MeteredRoom room(faces, 100.0f, [](Scene& scene) {
        scene.lights.push_back(
            support::make_lamp(PunctualLight::Kind::point, 100.0f, {2.0f, 2.5f, 2.0f}));
    });
    for (const float z : {0.1f, 1.0f, 2.0f, 3.9f}) {
        EXPECT_TRUE(room.read({{-0.1f, 0.75f, z}}).inside) << z;
        EXPECT_TRUE(room.read({{4.04f, 0.75f, z}}).inside) << z;
        EXPECT_FALSE(room.read({{0.1f, 0.75f, z}}).inside) << z;
    }
}
