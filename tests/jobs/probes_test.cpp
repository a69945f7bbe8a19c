// Light probes of solved scenes against paths.

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "../support/temporary_folder.h"
#include "jobs/bake/bake.h"
#include "paper_house.h"
#include "results/measure/light_probe.h"
#include "solved.h"
#include "truth/averages.h"
#include "truth/bounce_samples.h"
#include "truth/path_tracer.h"

namespace lumel {
namespace {

constexpr double kPi = std::numbers::pi;

using Nine = std::array<glm::dvec3, 9>;

Nine harmonics_of(const glm::dvec3& n)
{
    const double y1 = std::sqrt(3.0 / (4.0 * kPi)), y2 = std::sqrt(15.0 / (4.0 * kPi));
    const double values[9] = {std::sqrt(1.0 / (4.0 * kPi)),
                              y1 * n.y,
                              y1 * n.z,
                              y1 * n.x,
                              y2 * n.x * n.y,
                              y2 * n.y * n.z,
                              std::sqrt(5.0 / (16.0 * kPi)) * (3.0 * n.z * n.z - 1.0),
                              y2 * n.x * n.z,
                              0.5 * y2 * (n.x * n.x - n.y * n.y)};
    Nine result;
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = glm::dvec3(values[i]);
    return result;
}

/// Rings of cells of the sphere, all of one area.
constexpr int kRings = 32, kAround = 64, kCells = kRings * kAround;

glm::vec3 in_cell(std::size_t cell, const glm::vec2& at)
{
    const double z = 2.0 * (double(cell / kAround) + double(at.x)) / kRings - 1.0;
    const double s = std::sqrt(1.0 - z * z);
    const double angle = 2.0 * kPi * (double(cell % kAround) + double(at.y)) / kAround;
    return {s * std::cos(angle), s * std::sin(angle), z};
}

/// Of direct light from irradiance alone: H(n) = Σ A_l c_lm Y_lm(n), so that
/// c_lm = 1/A_l ∫ H(n) Y_lm(n) dn.
Nine direct_by_paths(const SolveScene& world, const glm::vec3& place, int samples)
{
    const PathTracer tracer(world.scene, world.rays, 0, Parts::direct);
    const auto light =
        average(kCells, samples,
                [&](std::size_t cell, std::uint32_t sample) {
                    const glm::vec3 normal = in_cell(cell, glm::vec2(0.5f));
                    const PathSamples path(PathSamples::hash(7, std::uint32_t(cell)), sample);
                    return glm::vec4(tracer.reflected({place, normal, Brdf(normal)}, path), 0.0f);
                },
                {});
    const double of_band[3] = {kPi, 2.0 * kPi / 3.0, kPi / 4.0};
    Nine sums{};
    for (std::size_t cell = 0; cell < kCells; ++cell) {
        const Nine y = harmonics_of(in_cell(cell, glm::vec2(0.5f)));
        for (std::size_t i = 0; i < y.size(); ++i)
            sums[i] += glm::dvec3(light[cell]) * y[i] * 4.0 * kPi / double(kCells) /
                       of_band[i < 1 ? 0 : (i < 4 ? 1 : 2)];
    }
    return sums;
}

/// Of what surfaces reflect, along rays from the place.
Nine reflected_by_paths(const SolveScene& world, const glm::vec3& place, int samples)
{
    constexpr int kMaxBounces = 1024;
    const PathTracer tracer(world.scene, world.rays, kMaxBounces);
    const Surfaces surfaces(world.scene);
    std::array<std::vector<glm::dvec3>, 9> of_cells;
    of_cells.fill(std::vector<glm::dvec3>(kCells, glm::dvec3(0.0)));
    average(kCells, samples,
            [&](std::size_t cell, std::uint32_t sample) {
                const PathSamples path(PathSamples::hash(8, std::uint32_t(cell)), sample);
                const glm::vec3 direction = in_cell(cell, path.stratified(kStartPair));
                RayHit hit;
                if (!world.rays.closest(place, direction, 0.0f, 1e30f, 0, hit))
                    return glm::vec4(0.0f);
                const glm::vec3 light = *tracer.radiance(place, direction, path) -
                                        hit.tint * surfaces.shade(hit).luminance;
                const Nine y = harmonics_of(direction);
                for (std::size_t i = 0; i < y.size(); ++i)
                    of_cells[i][cell] +=
                        glm::dvec3(light) * y[i] * 4.0 * kPi / double(kCells * samples);
                return glm::vec4(0.0f);
            },
            {});
    Nine sums{};
    for (std::size_t i = 0; i < sums.size(); ++i)
        for (const glm::dvec3& value : of_cells[i])
            sums[i] += value;
    return sums;
}

/// samples: of each cell, beside half as many for direct light.
Nine coefficients_by_paths(const SolveScene& world, const glm::vec3& place, int samples)
{
    Nine sums = direct_by_paths(world, place, samples / 2);
    const Nine reflected = reflected_by_paths(world, place, samples);
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] += reflected[i];
    return sums;
}

/// Bars: 2 % of band 0, in each channel.
void expect_probes_like_paths(const SolveScene& world, double error,
                              const std::vector<glm::vec3>& places, int samples)
{
    const support::Solved solved =
        support::solve_scene(world, {.method = LinksOptions{}, .target_error = error});
    const LightProbe probe(world.scene, world.rays, world.atlas, world.lumels, solved.irradiance,
                           {});
    double worst = 0.0, noise = 0.0;
    for (std::size_t p = 0; p < places.size(); ++p) {
        SCOPED_TRACE(testing::Message() << "probe " << p);
        const ProbeLight found = probe.read(places[p], std::uint32_t(p));
        EXPECT_FALSE(found.inside);
        const auto truth = coefficients_by_paths(world, places[p], samples);
        for (int c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < truth.size(); ++i) {
                const double off = (double(found.coefficients[i][c]) - truth[i][c]) / truth[0][c];
                worst = std::max(worst, std::abs(off));
                EXPECT_LE(std::abs(off), 0.02) << "coefficient " << i << ", channel " << c;
            }
        noise = std::max(noise, found.noise / double(found.coefficients[0].g));
    }
    std::printf("worst coefficient %.2f %% of band 0, stated noise at most %.2f %%\n",
                100.0 * worst, 100.0 * noise);
}

TEST(Probes, InTheCornellBoxAreWhatPathsFind)
{
    const SolveScene world(support::scene_path("cornell-box"), AtlasOptions{.size = 128});
    expect_probes_like_paths(world, 0.01,
                             {{0.278f, 0.4f, 0.1f}, {0.1f, 0.2f, 0.45f}, {0.278f, 0.5f, 0.3f}}, 64);
}

TEST(Probes, InAFurnishedRoomAreWhatPathsFind)
{
    const SolveScene world(support::scene_path("room"), AtlasOptions{.size = 256});
    expect_probes_like_paths(world, 0.02,
                             {{1.5f, 1.3f, 2.0f}, {2.5f, 0.4f, 3.5f}, {1.2f, 2.3f, 0.5f}}, 64);
}

TEST(Probes, InARoomUnderSunAndSkyAreWhatPathsFind)
{
    // From the west, through the window.
    LightOptions day;
    set_sun(day, "265,35");
    const SolveScene world(
        read_scene(support::scene_path("two-rooms-window"), MaterialModel::diffuse, day),
        AtlasOptions{.size = 128});
    expect_probes_like_paths(world, 0.01,
                             {{2.0f, 1.3f, 1.5f}, {3.5f, 2.0f, 0.5f}, {3.0f, 1.2f, 3.6f}}, 256);
}

TEST(Probes, InsideOfABlockAreRefusedWhetherItsMaterialIsDoubleSidedOrNot)
{
    for (const bool double_sided : {false, true}) {
        SCOPED_TRACE(double_sided);
        Scene scene = test::paper_house(double_sided);
        test::add_bulb(scene);
        const SolveScene world(std::move(scene), AtlasOptions{.size = 128});
        const support::Solved solved =
            support::solve_scene(world, {.method = LinksOptions{}, .target_error = 0.02});
        const LightProbe probe(world.scene, world.rays, world.atlas, world.lumels,
                               solved.irradiance, {});
        EXPECT_TRUE(probe.read({1.4f, 0.4f, 1.4f}, 0).inside);
        EXPECT_TRUE(probe.read({1.75f, 0.85f, 1.05f}, 1).inside);
        EXPECT_FALSE(probe.read({1.4f, 0.95f, 1.4f}, 2).inside);
        EXPECT_FALSE(probe.read({0.02f, 0.02f, 0.02f}, 3).inside);
    }
}

TEST(Probes, OfABakeThatAreStoppedLeaveTheBakeWithoutThem)
{
    const test::TemporaryFolder folder;
    BakeOptions options;
    options.atlas.size = 16;
    options.preview_width = 0;
    options.probe_spacing = 0.05;
    options.solver.max_shots = 24;
    bool is_done = false;
    const BakeSummary summary = bake(support::scene_path("cornell-box"), folder / "out", options,
                                     [&](const BakeProgress& now) {
                                         is_done = is_done || now.stage == "writing";
                                         return !(is_done && now.stage == "rays");
                                     });
    EXPECT_TRUE(summary.interrupted);
    EXPECT_TRUE(std::filesystem::exists(folder / "out/lightmap.exr"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/probes.json"));
}

}  // namespace
}  // namespace lumel
