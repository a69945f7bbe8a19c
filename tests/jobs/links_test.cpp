// Gathering over links where it could go wrong: bright closed rooms, dark places, scenes far away,
// and what it states of itself.

#include <fstream>
#include <numbers>
#include <sstream>

#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "../support/box_lumels.h"
#include "../support/closed_forms.h"
#include "../support/lamps.h"
#include "../support/temporary_folder.h"
#include "base/core/state_bytes.h"
#include "closed_room.h"
#include "links/trace/links.h"
#include "truth/reference.h"

namespace lumel {
namespace {

using support::Solved;

SolverOptions links(double error, std::uint32_t seed = 1)
{
    return {.method = LinksOptions{.seed = seed}, .target_error = error};
}

/// A closed room of one albedo whose walls all shine alike.
class ClosedRoom : public testing::TestWithParam<float> {};

INSTANTIATE_TEST_SUITE_P(OfAlbedo, ClosedRoom, testing::Values(0.9f, 0.98f, 0.99f, 0.995f, 0.999f),
                         [](const auto& test) {
                             return std::to_string(int(std::lround(1000.0f * test.param)));
                         });

TEST_P(ClosedRoom, GlowsAsItsAbsorptionAllows)
{
    const double truth = furnace_irradiance(1.0, double(GetParam()));
    EXPECT_NEAR(support::mean_in_closed_room(GetParam(), links(0.02)), truth, 0.01 * truth);
}

/// The path-traced truth has the same cap.
TEST(Links, ReflectAtMostTheMaximumAlbedo)
{
    Scene scene = read_gltf(support::scene_path("furnace-0.9"));
    for (Material& material : scene.materials)
        material.base_color = glm::vec4(1.0f);
    const SolveScene world(std::move(scene), AtlasOptions{.size = 32});
    const double truth = furnace_irradiance(1.0, double(kMaxAlbedo));
    const std::vector<glm::vec3> solved = support::solve_scene(world, links(0.02)).irradiance,
                                 traced =
                                     reference_irradiance(world.scene, world.rays, world.lumels,
                                                          {.samples_per_lumel = 64});
    const auto mean = [](const std::vector<glm::vec3>& light) {
        double sum = 0.0;
        for (const glm::vec3& one : light)
            sum += double(one.g);
        return sum / double(light.size());
    };
    EXPECT_NEAR(mean(solved), truth, 0.01 * truth);
    EXPECT_NEAR(mean(traced), truth, 0.02 * truth);
}

TEST(Links, RefuseARoomThatAbsorbsNothing)
{
    try {
        support::mean_in_closed_room(1.0f, links(0.02));
        FAIL() << "it was solved";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("absorbed"), std::string::npos) << error.what();
    }
}

/// 5 cm below the ceiling of a room of 3 m, a lamp makes a spot that few rays meet and that sends
/// two fifths of the light. Which of the first rays have met it must not decide how many follow.
TEST(Links, KeepTheLevelOfARoomThatASmallSpotLights)
{
    constexpr std::uint32_t kSeeds = 12;
    constexpr float kCandela = 100.0f, kAlbedo = 0.8f;
    support::Quad look{.albedo = glm::vec3(kAlbedo)};
    look.res_u = look.res_v = 32;
    const auto walls = support::box_walls({0, 0, 0}, {3.0f, 2.5f, 3.0f}, true, look);
    const std::vector<support::Quad> quads(walls.begin(), walls.end());
    support::HandMade room = support::make_quads(quads);
    room.scene.lights.push_back(
        support::make_lamp(PunctualLight::Kind::point, kCandela, {2.0f, 2.45f, 1.6f}));
    const Atlas atlas = support::lay_out(room, quads);
    const SolveScene world(room.scene, atlas, room.lumels);
    double sum = 0.0, area = 0.0;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        SolverOptions options = links(0.002, seed);
        options.max_shots = 96;
        const std::vector<glm::vec3> light = support::solve_scene(world, options).irradiance;
        for (std::size_t i = 0; i < light.size(); ++i) {
            sum += double(room.lumels.lumels[i].area) * double(light[i].g);
            area += double(room.lumels.lumels[i].area);
        }
    }
    // All light of the lamp is absorbed: Φ = Σ A (1 - ρ) H.
    const double truth =
        4.0 * std::numbers::pi * double(kCandela) * kSeeds / (area * (1.0 - double(kAlbedo)));
    EXPECT_NEAR(sum / area, truth, 0.01 * truth);
}

/// Two rooms side by side, the first with a glowing wall. open: without the walls between them.
std::vector<support::Quad> two_rooms(bool open)
{
    support::Quad look;
    look.res_u = look.res_v = 8;
    auto lit = support::box_walls({0, 0, 0}, {1, 1, 1}, true, look);
    const auto dark = support::box_walls({1.1f, 0, 0}, {2.1f, 1, 1}, true, look);
    lit[0].emission = glm::vec3(1.0f);
    std::vector<support::Quad> quads;
    for (std::size_t wall = 0; wall < lit.size(); ++wall)
        if (!open || wall != 1)
            quads.push_back(lit[wall]);
    for (std::size_t wall = 0; wall < dark.size(); ++wall)
        if (!open || wall != 0)
            quads.push_back(dark[wall]);
    return quads;
}

TEST(Links, LeaveSpaceThatNoLightReachesAfterARound)
{
    for (const bool open : {false, true}) {
        const std::vector<support::Quad> quads = two_rooms(open);
        support::HandMade rooms = support::make_quads(quads);
        const Atlas atlas = support::lay_out(rooms, quads);
        const SolveScene world(rooms.scene, atlas, rooms.lumels);
        LinkRadiosity light(world, LinksOptions{}, {.target_error = 0.003});
        while (light.state().shots == 0 || light.state().error > 0.003)
            light.step();
        const StoredLinks kept = light.kept("");
        ASSERT_GT(kept.rounds.size(), 1u);
        const std::vector<glm::vec3> irradiance = light.irradiance();
        for (std::size_t i = rooms.first[quads.size() / 2]; i < irradiance.size(); ++i) {
            EXPECT_EQ(irradiance[i].g > 0.0f, open);
            const auto sends = [&](const std::vector<std::uint16_t>& rays) { return rays[i] > 0; };
            EXPECT_TRUE(std::ranges::all_of(kept.rounds.front().rays, sends));
            EXPECT_EQ(std::ranges::any_of(kept.rounds.back().rays, sends), open) << "lumel " << i;
        }
    }
}

/// A glowing wall and a floor that meet at a right angle, each 1 m², and a black ground far below.
Scene wall_and_floor(float metres_of_ground)
{
    Scene scene;
    support::add_quad(scene, {.edge_u = {0, 0, 1}, .edge_v = {1, 0, 0}, .albedo = glm::vec3(0)});
    support::add_quad(scene, {.edge_u = {0, 1, 0},
                              .edge_v = {0, 0, 1},
                              .albedo = glm::vec3(0),
                              .emission = glm::vec3(1)});
    if (const float side = metres_of_ground; side > 0.0f) {
        support::add_quad(scene, {.corner = {-0.5f * side, -1, -0.5f * side},
                                  .edge_u = {0, 0, side},
                                  .edge_v = {side, 0, 0},
                                  .albedo = glm::vec3(0)});
        scene.instances.back().name = "ground";
    }
    return scene;
}

/// The wall's light is that of its form factor, however far the scene extends: rays start close to
/// small surfaces.
TEST(Links, AndPathsLightASmallRoomOnAGroundOfAKilometreAsWithoutIt)
{
    constexpr double kFormFactor = 0.200044;
    for (const float metres : {0.0f, 1000.0f}) {
        const SolveScene world(
            wall_and_floor(metres),
            AtlasOptions{.texels_per_metre = 16.0f, .densities = {{"ground", 0.02f}}});
        const auto mean = [&](const std::vector<glm::vec3>& light) {
            double sum = 0.0, area = 0.0;
            for (std::size_t i = 0; i < light.size(); ++i)
                if (const Lumel& lumel = world.lumels.lumels[i]; lumel.instance == 0) {
                    sum += double(lumel.area) * double(light[i].g);
                    area += double(lumel.area);
                }
            return sum / area;
        };
        EXPECT_NEAR(mean(support::solve_scene(world, links(0.02)).irradiance), kFormFactor,
                    0.002 * kFormFactor)
            << metres;
        EXPECT_NEAR(mean(reference_irradiance(world.scene, world.rays, world.lumels,
                                              {.samples_per_lumel = 256})),
                    kFormFactor, 0.005 * kFormFactor)
            << metres;
    }
}

/// Large enough for passes of several steps.
TEST(Links, GoOnFromTheStateAfterAnyStepToTheSameLight)
{
    const SolveScene world(support::scene_path("cornell-box"), {.size = 192});
    const SolverOptions options = links(0.01);  // in two rounds
    const support::Resident resident(world.scene, world.rays, world.lumels, options, &world.atlas);
    const auto make = [&] {
        return make_solver({.device = &resident.device,
                            .world = &resident.world,
                            .lumels = world.lumels,
                            .near = resident.near,
                            .scene = &world},
                           options);
    };
    std::vector<std::string> states;
    const auto undisturbed = make();
    ASSERT_TRUE(solve(*undisturbed, options, [&](const SolverState&) {
        std::ostringstream bytes;
        StateWriter writer(bytes);
        undisturbed->write_state(writer);
        writer.finish();
        states.push_back(bytes.str());
        return true;
    }));
    ASSERT_GT(states.size(), 8u);
    for (std::size_t step = 0; step < states.size(); ++step) {
        std::istringstream bytes(states[step]);
        StateReader reader(bytes, states[step].size(), "a state");
        const auto solver = make();
        solver->read_state(reader);
        reader.finish();
        ASSERT_TRUE(solve(*solver, options));
        ASSERT_EQ(solver->irradiance(), undisturbed->irradiance()) << "after step " << step;
        ASSERT_EQ(solver->state().iterations, undisturbed->state().iterations);
        ASSERT_EQ(solver->state().error, undisturbed->state().error);
    }
}

/// The Cornell box in a file whose root moves it.
std::string moved_file(const test::TemporaryFolder& folder, double metres)
{
    std::ifstream in(support::scene_path("cornell-box"));
    nlohmann::json file = nlohmann::json::parse(in);
    nlohmann::json& roots = file["scenes"][0]["nodes"];
    file["nodes"].push_back(
        {{"translation", {metres, -0.5 * metres, 0.25 * metres}}, {"children", roots}});
    roots = {file["nodes"].size() - 1};
    const std::string path = folder / "moved.gltf";
    std::ofstream(path) << file;
    return path;
}

TEST(Links, LightASceneFarAwayAsTheyDoHere)
{
    const AtlasOptions options{.size = 48};
    const SolveScene near(support::scene_path("cornell-box"), options);
    const Solved there = support::solve_scene(near, links(0.05));
    const std::vector<glm::vec3> truth =
        reference_irradiance(near.scene, near.rays, near.lumels, {.samples_per_lumel = 16});
    const auto all = [](const Lumel&) { return true; };
    const test::TemporaryFolder folder;
    for (const double metres : {1e3, 1e4, 1e5, 1e6}) {
        const SolveScene far(moved_file(folder, metres), options);
        ASSERT_EQ(far.lumels.lumels.size(), near.lumels.lumels.size());
        const Solved solved = support::solve_scene(far, links(0.05));
        const support::LumelError apart =
            support::lumel_error(near.lumels, solved.irradiance, there.irradiance, all);
        const support::LumelError traced = support::lumel_error(
            near.lumels,
            reference_irradiance(far.scene, far.rays, far.lumels, {.samples_per_lumel = 16}), truth,
            all);
        std::printf("%g m: %.4f %%, reference %.4f %%\n", metres, 100.0 * apart.rmse,
                    100.0 * traced.rmse);
        EXPECT_LE(apart.rmse, 1e-3) << metres << " m";
        EXPECT_LE(std::abs(traced.bias), 1e-3) << metres << " m";
    }
}

TEST(Links, GiveTheSameBytesOnAnyNumberOfThreads)
{
    const SolveScene world(support::scene_path("two-rooms"), {.size = 48});
    const Solved many = support::solve_scene(world, links(0.05));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Solved alone = support::solve_scene(world, links(0.05));
    EXPECT_EQ(many.irradiance, alone.irradiance);
    EXPECT_EQ(many.state.error, alone.state.error);
}

struct Case {
    const char* scene;
    int size;
};

class StatedByLinks : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Of, StatedByLinks,
                         testing::Values(Case{"cornell-box", 24}, Case{"cornell-box", 32},
                                         Case{"cornell-box", 64}, Case{"two-rooms", 64}),
                         [](const auto& test) {
                             std::string name = test.param.scene + std::to_string(test.param.size);
                             std::erase(name, '-');
                             return name;
                         });

// Both figures, against the reference without its own noise.
TEST_P(StatedByLinks, IsTheRealError)
{
    const SolveScene world(support::scene_path(GetParam().scene), {.size = GetParam().size});
    std::vector<glm::vec3> truth[2];
    for (std::uint32_t k = 0; k < 2; ++k)
        truth[k] = reference_irradiance(world.scene, world.rays, world.lumels,
                                        {.samples_per_lumel = 256, .seed = 101 + k});
    double stated = 0.0, real = 0.0;
    constexpr std::uint32_t kSeeds = 4;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        const Solved solved = support::solve_scene(world, links(0.03, seed));
        stated += solved.state.error / kSeeds;
        real += support::error_alone(solved.irradiance, truth[0], truth[1]) / kSeeds;
    }
    testing::Test::RecordProperty("stated", std::to_string(stated));
    std::printf("stated %.2f %%, real %.2f %%\n", 100.0 * stated, 100.0 * real);
    EXPECT_GE(stated / real, 0.75);
    EXPECT_LE(stated / real, 1.5);
}

/// [N] Light around each lumel by definition: the mean of its chart or of its neighbours there, at
/// least 2 % of the mean. Of scenes without double-sided surfaces.
std::vector<double> light_around(const Lumels& lumels, const std::vector<glm::vec3>& truth)
{
    const auto light = [&](std::size_t i) { return double(truth[i].r + truth[i].g + truth[i].b); };
    double mean = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i)
        mean += light(i) / double(truth.size());
    std::vector<double> around(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const Lumel& one = lumels.lumels[i];
        double chart = 0.0, lumels_of_chart = 0.0, nearby = 0.0, weight = 0.0;
        for (std::size_t j = 0; j < truth.size(); ++j) {
            const Lumel& other = lumels.lumels[j];
            if (other.chart != one.chart || (other.flags & kLumelBuried))
                continue;
            chart += light(j);
            lumels_of_chart += 1.0;
            const int dx = int(other.texel) % lumels.width - int(one.texel) % lumels.width,
                      dy = int(other.texel) / lumels.width - int(one.texel) / lumels.width;
            const double w = i == j ? 0.0 : std::exp(-(dx * dx + dy * dy) / 8.0);
            nearby += w * light(j);
            weight += w;
        }
        around[i] = std::max({lumels_of_chart > 0.0 ? chart / lumels_of_chart : 0.0,
                              weight > 0.1 ? nearby / weight : 0.0, 0.02 * mean});
    }
    return around;
}

// Both figures, against the reference without its own noise.
TEST_P(StatedByLinks, IsTheRealErrorForAnEye)
{
    const SolveScene world(support::scene_path(GetParam().scene), {.size = GetParam().size});
    std::vector<glm::vec3> truth[2], both;
    for (std::uint32_t k = 0; k < 2; ++k)
        truth[k] = reference_irradiance(world.scene, world.rays, world.lumels,
                                        {.samples_per_lumel = 256, .seed = 101 + k});
    for (std::size_t i = 0; i < truth[0].size(); ++i)
        both.push_back(0.5f * (truth[0][i] + truth[1][i]));
    const std::vector<double> around = light_around(world.lumels, both);
    double stated = 0.0, real = 0.0;
    constexpr std::uint32_t kSeeds = 4;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        const Solved solved = support::solve_scene(world, {.method = LinksOptions{.seed = seed},
                                                           .target_error = 0.0,
                                                           .target_quality = {.eye_error = 0.03}});
        double square = 0.0, count = 0.0;
        for (std::size_t i = 0; i < both.size(); ++i) {
            if (world.lumels.lumels[i].flags & kLumelBuried)
                continue;
            const glm::dvec3 one = solved.irradiance[i] - truth[0][i],
                             other = solved.irradiance[i] - truth[1][i];
            square += 3.0 * glm::dot(one, other) / (around[i] * around[i]);
            count += 1.0;
        }
        stated += solved.state.eye_error / kSeeds;
        real += std::sqrt(std::max(square, 0.0) / count) / kSeeds;
    }
    testing::Test::RecordProperty("stated", std::to_string(stated));
    std::printf("stated %.2f %%, real %.2f %%\n", 100.0 * stated, 100.0 * real);
    EXPECT_LE(stated, 0.03);
    EXPECT_GE(stated / real, 0.75);
    EXPECT_LE(stated / real, 1.5);
}

}  // namespace
}  // namespace lumel
