// The glossy solver: energy in closed rooms, and what it has in common with the diffuse one.

#include "methods/glossy/glossy.h"
#include "solved.h"

namespace lumel {
namespace {

/// The furnace (a closed box whose walls emit 1 lm/m²) with other reflectances.
struct GlossyRoom {
    float diffuse, specular, shininess;
};

std::ostream& operator<<(std::ostream& out, const GlossyRoom& room)
{
    return out << room.diffuse << " diffuse, " << room.specular << " specular, n "
               << room.shininess;
}

struct GlossySolution {
    EnergyBalance energy;
    double glow = 0.0;  ///< area-weighted mean of E + ρ_d H
};

GlossySolution solve_room(const GlossyRoom& room, std::uint64_t shots)
{
    SolveScene furnace(support::scene_path("furnace-0.5"), AtlasOptions{.size = 40});
    for (Gloss& gloss : furnace.lumels.gloss)
        gloss = {glm::vec3(room.diffuse), glm::vec3(room.specular), room.shininess};
    const SolverOptions options{.method = GlossyOptions{}, .max_shots = shots, .target_error = 0.0};
    const support::Resident resident(furnace.scene, furnace.rays, furnace.lumels, options);
    const auto& [near, device, world] = resident;
    const LobeParticles particles(furnace);
    GlossyIllumination solver(device, world, furnace.lumels, near,
                              std::get<GlossyOptions>(options.method), {}, &particles);
    EXPECT_TRUE(solve(solver, options));

    GlossySolution solution;
    const std::vector<glm::vec3> irradiance = solver.irradiance();
    double area = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = furnace.lumels.lumels[i];
        const double h = double(irradiance[i].g);
        EXPECT_TRUE(std::isfinite(h) && h >= 0.0);
        solution.glow += double(lumel.area) * (double(lumel.emission.g) + room.diffuse * h);
        area += double(lumel.area);
    }
    solution.glow /= area;
    solution.energy = solver.energy();
    EXPECT_EQ(device.validation_messages(), "");
    return solution;
}

class ClosedGlossyRoom : public testing::TestWithParam<GlossyRoom> {};

TEST_P(ClosedGlossyRoom, AbsorbsWhatItEmits)
{
    const EnergyBalance energy = solve_room(GetParam(), 8192).energy;
    EXPECT_NEAR(energy.absorbed, energy.emitted, 0.01 * energy.emitted);
}

INSTANTIATE_TEST_SUITE_P(Materials, ClosedGlossyRoom,
                         testing::Values(GlossyRoom{0.5f, 0.0f, 1.0f}, GlossyRoom{0.3f, 0.3f, 1.0f},
                                         GlossyRoom{0.0f, 0.5f, 10.0f},
                                         GlossyRoom{0.3f, 0.5f, 30.0f},
                                         GlossyRoom{0.1f, 0.7f, 100.0f},
                                         GlossyRoom{0.0f, 0.9f, 1000.0f}));

TEST(ClosedGlossyRoom, WithoutGlossGlowsAsTheFurnace)
{
    EXPECT_NEAR(solve_room({0.5f, 0.0f, 1.0f}, 8192).glow, 2.0, 0.01 * 2.0);
}

TEST(GlossyCornellBox, OfDiffuseWallsAgreesWithTheDiffuseSolver)
{
    SolveScene world(support::scene_path("cornell-box"), AtlasOptions{.size = 64});
    for (std::size_t i = 0; i < world.lumels.gloss.size(); ++i)
        world.lumels.gloss[i] = {world.lumels.lumels[i].albedo, glm::vec3(0.0f), 1.0f};
    const auto diffuse = support::solve_scene(
        world, {.method = StochasticOptions{}, .max_shots = 8192, .target_error = 0.0});
    const auto glossy = support::solve_scene(
        world, {.method = GlossyOptions{}, .max_shots = 32768, .target_error = 0.0});
    const support::LumelError error = support::lumel_error(
        world.lumels, glossy.irradiance, diffuse.irradiance, [](const Lumel&) { return true; });
    EXPECT_LE(error.rmse, 0.05);
    EXPECT_LE(std::abs(error.bias), 0.01);
}

}  // namespace
}  // namespace lumel
