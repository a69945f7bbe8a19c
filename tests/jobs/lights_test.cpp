// Sky, sun and lamps through a whole bake.

#include "../support/box_lumels.h"
#include "jobs/solve/lighting.h"
#include "raster/shadow_maps/direct_light.h"
#include "scene/sky/clear_sky.h"
#include "solve/shooting/lumel_arrays.h"
#include "solved.h"
#include "truth/reference.h"

namespace lumel {
namespace {

constexpr int kSize = 64;  // of atlases [texels]

/// The light inside the closed box under a bright sky that is gathered from the maps.
double light_inside(Layers layers)
{
    const Scene scene = read_scene(support::scene_path("sealed-box"), MaterialModel::diffuse,
                                   {.sky_color = glm::vec3(1e4f)});
    const SolveScene world(scene, AtlasOptions{.size = kSize});
    const support::Solved solved = support::solve_scene(
        world, {.method = DirectionsOptions{.iteration = {Scheme::paper}, .layers = layers},
                .max_shots = 1024,
                .target_error = 0.0});
    double inside = 0.0, outside = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < solved.irradiance.size(); ++i) {
        const double h = double(solved.irradiance[i].g);
        if (world.scene.instances[world.lumels.lumels[i].instance].name == "box inside") {
            inside += h;
            ++count;
        }
        outside = std::max(outside, h);
    }
    EXPECT_GT(count, 50u);
    EXPECT_GT(outside, 1e4);
    return inside / double(count);
}

TEST(SealedBox, UnderAWhiteSkyStaysExactlyDarkInside)
{
    EXPECT_EQ(light_inside(Layers::list), 0.0);
}

// A line through the box meets six surfaces at most: floor, lamp, and both shells twice. Two of
// them, the shells, are between a point inside and the sky. Each stands in a pixel by chance, so
// the chance that none of the nine pixels read shows one is C_9 of [TN11] Figure 7.
TEST(SealedBox, LeaksThroughStochasticLayersAsOftenAsNoneOfNineShowsAShell)
{
    const double leak = light_inside(Layers::stochastic) / (1e4 * double(support::kPi));
    EXPECT_GT(leak, 0.0);
    EXPECT_LT(leak, std::pow(1.0 - 2.0 / 6.0, 9.0));
}

/// The city under a white sky, whose direct light is found.
struct City {
    City()
        : world(read_scene(support::scene_path("city"), MaterialModel::diffuse,
                           {.sky_color = glm::vec3(1.0f)}),
                AtlasOptions{.size = kSize}),
          resident(device, world.scene, world.lumels, &world.atlas),
          direct(direct_light(device, resident, world.scene, world.lumels, {}).irradiance),
          lit(shining(world.lumels, direct).value())
    {
    }

    /// What surfaces send one another, with all light added that is direct.
    support::Solved solve(const SolverOptions& options) const
    {
        const NearField near = near_field_for(world.scene, world.rays, lit, options);
        const auto solver = make_solver({.device = &device,
                                         .world = &resident,
                                         .lumels = lit,
                                         .near = near,
                                         .known = direct,
                                         .scene = &world},
                                        options);
        EXPECT_TRUE(lumel::solve(*solver, options));
        support::Solved solved{solver->irradiance(), solver->state()};
        add_light(solved.irradiance, direct);
        EXPECT_EQ(device.validation_messages(), "");
        return solved;
    }

    support::LumelError apart(const support::Solved& a, const support::Solved& b) const
    {
        return support::lumel_error(world.lumels, a.irradiance, b.irradiance,
                                    [](const Lumel&) { return true; });
    }

    SolveScene world;
    gpu::Device device;
    World resident;
    std::vector<glm::vec3> direct;
    Lumels lit;
};

TEST(City, IsLitAlikeByShootersAndAlongGlobalDirections)
{
    const City city;
    const SolverOptions shooters{
        .method = StochasticOptions{}, .max_shots = 2048, .target_error = 0.0};
    SolverOptions directions = shooters;
    directions.method = DirectionsOptions{};
    const support::LumelError apart = city.apart(city.solve(directions), city.solve(shooters));
    EXPECT_LE(apart.rmse, 0.02);
    EXPECT_LE(std::abs(apart.bias), 0.005);
}

// Most of the light comes straight from the sky: the error stated is a part of all light. (Among
// shooters it leaves out the near field's, of which the city has much.)
TEST(City, TheEstimatedErrorIsHonest)
{
    const City city;
    const support::Solved truth = city.solve(
        {.method = DirectionsOptions{.seed = 9}, .max_shots = 8192, .target_error = 0.0});
    double stated = 0.0, real = 0.0;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const support::Solved solved = city.solve(
            {.method = DirectionsOptions{.seed = seed}, .max_shots = 512, .target_error = 0.0});
        stated += solved.state.error;
        real += city.apart(solved, truth).rmse;
    }
    EXPECT_GT(stated, 0.75 * real);
    EXPECT_LT(stated, 1.5 * real);
}

TEST(GlobalDirections, ReturnDirectAndReflectedLightApart)
{
    const SolveScene world(support::scene_path("cornell-box"), AtlasOptions{.size = 32});
    const gpu::Device device;
    const World resident(device, world.scene, world.lumels, &world.atlas);
    const SolverOptions options{
        .method = DirectionsOptions{}, .max_shots = 256, .target_error = 0.001};
    const auto sum_of = [&](Parts parts) {
        const auto solver = make_solver({.device = &device,
                                         .world = &resident,
                                         .lumels = world.lumels,
                                         .near = {},
                                         .scene = &world,
                                         .parts = parts},
                                        options);
        EXPECT_TRUE(lumel::solve(*solver, options));
        return irradiance_sum(solver->irradiance());
    };
    const double all = sum_of(Parts::all), direct = sum_of(Parts::direct),
                 indirect = sum_of(Parts::indirect);
    EXPECT_GT(direct, 0.3 * all);
    EXPECT_GT(indirect, 0.3 * all);
    EXPECT_NEAR(direct + indirect, all, 1e-3 * all);
    EXPECT_EQ(device.validation_messages(), "");
}

// Most of the error is in the lumels that the patch of sun ends in.
TEST(TwoRooms, SunThroughTheWindowIsAsPathTraced)
{
    const SolveScene world(
        read_scene(
            support::scene_path("two-rooms-window"), MaterialModel::diffuse,
            {.sky_color = glm::vec3(0.0f),
             .sun = SunPosition{.azimuth = glm::radians(280.0), .elevation = glm::radians(35.0)}}),
        AtlasOptions{.size = kSize});
    std::array<std::vector<glm::vec3>, 2> half;
    for (std::uint32_t h = 0; h < 2; ++h)
        half[h] = reference_irradiance(
            world.scene, world.rays, world.lumels,
            {.samples_per_lumel = 2048, .seed = 1 + h, .parts = Parts::direct});
    const gpu::Device device;
    const World resident(device, world.scene, world.lumels);
    const std::vector<glm::vec3> irradiance =
        direct_light(device, resident, world.scene, world.lumels, {}).irradiance;
    EXPECT_LE(support::error_alone(irradiance, half[0], half[1]), 0.02);
    EXPECT_LE(
        std::abs(support::lumel_error(world.lumels, irradiance, support::mean_of(half[0], half[1]),
                                      [](const Lumel&) { return true; })
                     .bias),
        0.005);
    EXPECT_EQ(device.validation_messages(), "");
}

/// A square of clear texels with an opaque disc in its middle, one metre above a floor.
constexpr float kLeafRadius = 0.35f;  // [m], of a square of 1 m

support::HandMade leaf_over_floor()
{
    const support::Quad floor{.corner = {-1.0f, 0.0f, 1.0f},
                              .edge_u = {2.0f, 0.0f, 0.0f},
                              .edge_v = {0.0f, 0.0f, -2.0f},
                              .res_u = 64,
                              .res_v = 64};
    const support::Quad leaf{.corner = {-0.5f, 1.0f, 0.5f},
                             .edge_u = {1.0f, 0.0f, 0.0f},
                             .edge_v = {0.0f, 0.0f, -1.0f},
                             .double_sided = true};
    support::HandMade made = support::make_quads({floor, leaf});
    constexpr int kTexels = 128;
    Texture texture{.width = kTexels, .height = kTexels};
    for (int y = 0; y < kTexels; ++y)
        for (int x = 0; x < kTexels; ++x) {
            const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / float(kTexels) - 0.5f;
            const std::uint8_t alpha = glm::length(at) < kLeafRadius ? 255 : 0;
            texture.rgba.insert(texture.rgba.end(), {255, 255, 255, alpha});
        }
    made.scene.textures.push_back(texture);
    Material& material = made.scene.materials[1];
    material.base_color_texture.texture = 0;
    material.alpha_mode = AlphaMode::mask;
    return made;
}

TEST(CutOut, CastsTheShadowOfItsShape)
{
    support::HandMade made = leaf_over_floor();
    const SunPosition position{.azimuth = 0.0, .elevation = glm::radians(70.0)};
    PunctualLight sun = sun_light(position);
    sun.angle = 0.0f;
    made.scene.lights.push_back(sun);
    const gpu::Device device;
    const World world(device, made.scene, made.lumels);
    const std::vector<glm::vec3> irradiance =
        direct_light(device, world, made.scene, made.lumels, {}).irradiance;
    EXPECT_EQ(device.validation_messages(), "");

    const glm::vec3 toward = direction_of(position);
    const glm::vec2 moved = -glm::vec2(toward.x, toward.z) / toward.y;  // one metre below
    const float open = sun.intensity * sun.color.x * toward.y, lumel = 2.0f / 64.0f;
    std::size_t in_shadow = 0;
    for (std::size_t i = made.first[0]; i < made.first[1]; ++i) {
        const glm::vec3 at = made.lumels.lumels[i].position;
        const float from_edge = glm::distance(glm::vec2(at.x, at.z), moved) - kLeafRadius;
        if (from_edge < -lumel) {
            ++in_shadow;
            EXPECT_EQ(irradiance[i].x, 0.0f) << at.x << ' ' << at.z;
        } else if (from_edge > lumel) {
            EXPECT_NEAR(irradiance[i].x, open, 0.005f * open) << at.x << ' ' << at.z;
        }
    }
    EXPECT_GT(in_shadow, 200u);
}

}  // namespace
}  // namespace lumel
