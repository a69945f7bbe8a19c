// From frame to frame: what changes a little should not flicker.

#include <cmath>
#include <memory>

#include <glm/gtc/matrix_transform.hpp>

#include "methods/glossy/glossy.h"
#include "results/picture/seen.h"
#include "solve/shooting/lumel_arrays.h"
#include "solved.h"

namespace lumel {
namespace {

/// Light of the previous frame is still present in the first of a frame's iterations: it leaves 2
/// % after 64 iterations, 0.7 % after these.
constexpr int kFrameSteps = 128;
/// Enough where the light stays as it was.
constexpr int kFewSteps = 64;

/// A lamp in a corner of the floor instead of the one that is there.
std::vector<glm::vec3> in_the_corner(const Lumels& lumels)
{
    std::vector<glm::vec3> emission;
    for (const Lumel& lumel : lumels.lumels) {
        const glm::vec3& at = lumel.position;
        const bool lamp = at.x > 0.45f && at.y < 0.01f && at.z < 0.1f;
        emission.emplace_back(lamp && !(lumel.flags & kLumelBuried) ? 10.0f : 0.0f);
    }
    return emission;
}

Lumels lit_by(Lumels lumels, const std::vector<glm::vec3>& emission)
{
    for (std::size_t i = 0; i < emission.size(); ++i)
        lumels.lumels[i].emission = emission[i];
    return lumels;
}

/// Who brings what lobes send on: shooters or particles.
enum class Lobes { shot, carried };

/// The glossy Cornell box with a solver at work on it.
struct Running {
    explicit Running(std::uint32_t seed,
                     std::vector<glm::vec3> (*lamps)(const Lumels&) = emission_of,
                     Lobes lobes = Lobes::shot, int steps_of_a_frame = kFrameSteps)
        : steps(steps_of_a_frame),
          world(read_gltf(support::scene_path("glossy-cornell-box"), MaterialModel::glossy),
                AtlasOptions{.size = 32}),
          lumels(lit_by(world.lumels, lamps(world.lumels))),
          options{.seed = seed},
          resident(world.scene, world.rays, lumels, {.method = options}),
          particles(world),
          solver(resident.device, resident.world, lumels, resident.near, options, {},
                 lobes == Lobes::carried ? &particles : nullptr)
    {
        step();
    }

    void step()
    {
        for (int i = 0; i < steps; ++i)
            solver.step();
    }

    /// A frame of that light.
    std::vector<glm::vec3> lit(const std::vector<glm::vec3>& emission)
    {
        solver.set_emission(emission);
        step();
        return solver.irradiance();
    }

    /// A frame with all lamps this much brighter.
    std::vector<glm::vec3> lit(float brightness)
    {
        std::vector<glm::vec3> emission = emission_of(lumels);
        for (glm::vec3& e : emission)
            e *= brightness;
        return lit(emission);
    }

    /// A frame of what a camera that was moved sideways sees reflected.
    std::vector<glm::vec3> seen(float sideways)
    {
        View view = view_of(world.scene.cameras.front());
        view.transform[3].x += sideways;
        const Seen points = look(view, 24, 24, 1, world.rays, world.surfaces, {});
        const std::vector<float> brightness = solver.brightness();
        solver.look_at(points.glossy, brightness, {points.first, std::uint64_t(steps) * 16, 0});
        step();
        return solver.eye_radiance();
    }

    int steps;
    SolveScene world;
    Lumels lumels;
    GlossyOptions options;
    support::Resident resident;
    LobeParticles particles;
    GlossyIllumination solver;
};

Running with_few_steps(std::uint32_t seed, Lobes lobes = Lobes::shot)
{
    return Running(seed, emission_of, lobes, kFewSteps);
}

/// Of all channels.
double sum(const std::vector<glm::vec3>& values)
{
    double sum = 0.0;
    for (const glm::vec3& value : values)
        sum += double(value.r) + double(value.g) + double(value.b);
    return sum;
}

/// RMSE of a - b in terms of the mean of b.
double difference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b)
{
    double square = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        for (int c = 0; c < 3; ++c) {
            square += std::pow(double(a[i][c]) - double(b[i][c]), 2.0);
            sum += double(b[i][c]);
        }
    const double n = 3.0 * double(std::min(a.size(), b.size()));
    return std::sqrt(square / n) / (sum / n);
}

/// Mean of |a - b|, all channels, in terms of the mean of b.
double mean_difference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b)
{
    std::vector<glm::vec3> apart;
    for (std::size_t i = 0; i < b.size(); ++i)
        apart.push_back(glm::abs(a[i] - b[i]));
    return sum(apart) / sum(b);
}

TEST(Frames, ALampThatBrightensALittleLeavesTheNoiseWhereItWas)
{
    Running same = with_few_steps(1), other = with_few_steps(2);
    const std::vector<glm::vec3> before = same.lit(1.0f), after = same.lit(1.01f);
    EXPECT_LE(difference(after, before), 0.5 * difference(other.lit(1.0f), before));
    EXPECT_EQ(same.resident.device.validation_messages(), "");
}

TEST(Frames, ALampThatBrightensALittleLeavesTheNoiseOfParticlesToo)
{
    Running same = with_few_steps(1, Lobes::carried), other = with_few_steps(2, Lobes::carried);
    const std::vector<glm::vec3> before = same.lit(1.0f), after = same.lit(1.01f);
    EXPECT_LE(difference(after, before), 0.5 * difference(other.lit(1.0f), before));
}

TEST(Frames, ACameraThatMovesALittleSeesTheSameNoise)
{
    Running same = with_few_steps(1), other = with_few_steps(2);
    const std::vector<glm::vec3> before = same.seen(0.0f), after = same.seen(1e-5f);
    EXPECT_LE(difference(after, before), 0.25 * difference(other.seen(0.0f), before));
    EXPECT_EQ(same.resident.device.validation_messages(), "");
}

TEST(Frames, ALampOfTwiceTheLightGivesTwiceTheLight)
{
    Running running(1);
    std::vector<glm::vec3> once = running.lit(1.0f);
    for (glm::vec3& h : once)
        h *= 2.0f;
    EXPECT_LE(difference(running.lit(2.0f), once), 0.02);
}

TEST(Frames, OfAnEyeThatStaysShowNoLampThatWentOut)
{
    Running running(1);
    const double lit = sum(running.seen(0.0f));
    running.lit(0.0f);
    EXPECT_LE(sum(running.solver.eye_radiance()), 0.1 * lit);
}

TEST(Frames, HaveTheBrightnessThatTheirShootersAreDrawnBy)
{
    Running running = with_few_steps(1);
    const std::vector<float> first = running.solver.brightness();
    running.lit(in_the_corner(running.lumels));
    EXPECT_EQ(running.solver.brightness(), first);
}

TEST(Frames, OnceForgottenLeaveNothingOfALampThatMoved)
{
    Running moved(1), never_knew(1, in_the_corner);
    moved.lit(in_the_corner(moved.lumels));
    moved.solver.forget_frames();
    const std::vector<float> brightness = moved.solver.brightness();
    const std::vector<float> expected = never_knew.solver.brightness();
    double apart = 0.0;
    for (std::size_t j = 0; j < brightness.size(); ++j)
        apart += double(std::abs(brightness[j] - expected[j]) * moved.lumels.lumels[j].area);
    EXPECT_LE(apart, 0.3);  // of 2 at most
}

// Shooters drawn where the light was in the first frame are noisy where it is elsewhere now.
TEST(Frames, OnceForgottenMakeLightThatMovedLessNoisy)
{
    Running running(1), long_run(2, in_the_corner);
    const std::vector<glm::vec3> emission = in_the_corner(running.lumels);
    const std::vector<glm::vec3> drawn_as_before = running.lit(emission);
    running.solver.forget_frames();
    const std::vector<glm::vec3> drawn_anew = running.lit(emission);
    for (int i = 0; i < 8; ++i)
        long_run.step();
    const std::vector<glm::vec3> truth = long_run.solver.irradiance();
    EXPECT_LE(mean_difference(drawn_anew, truth), 0.6 * mean_difference(drawn_as_before, truth));
}

/// The glossy Cornell box whose tall block has been turned, with what solves it.
struct Turned {
    /// same: whose atlas it has.
    explicit Turned(double degrees, float brightness = 1.0f, const Turned* same = nullptr,
                    Scheme scheme = Scheme::phased)
        : world(scene(degrees, brightness),
                [&](const Scene& posed, const RayScene&, const ProgressCallback& progress) {
                    return same ? same->world.atlas : make_atlas(posed, {.size = 32}, progress);
                }),
          options{.scheme = scheme},
          resident(world.scene, world.rays, world.lumels, {.method = options}),
          particles(world)
    {
    }

    static Scene scene(double degrees, float brightness)
    {
        Scene scene = read_gltf(support::scene_path("glossy-cornell-box"), MaterialModel::glossy);
        glm::mat4& place = scene.instances[find_instance(scene, "tall block")].transform;
        const glm::vec3 pivot(0.37f, 0.0f, 0.35f);  // about its middle [m]
        place = glm::translate(glm::mat4(1.0f), pivot) *
                glm::rotate(glm::mat4(1.0f), float(glm::radians(degrees)), {0.0f, 1.0f, 0.0f}) *
                glm::translate(glm::mat4(1.0f), -pivot) * place;
        for (Material& material : scene.materials)
            material.emitted *= brightness;
        return scene;
    }

    std::unique_ptr<GlossyIllumination> start(std::uint32_t seed) const
    {
        GlossyOptions own = options;
        own.seed = seed;
        return std::make_unique<GlossyIllumination>(resident.device, resident.world, world.lumels,
                                                    resident.near, own,
                                                    std::span<const glm::vec3>{}, &particles);
    }

    SolveScene world;
    GlossyOptions options;
    support::Resident resident;
    LobeParticles particles;
};

std::vector<glm::vec3> after(GlossyIllumination& solver, int iterations)
{
    for (int i = 0; i < iterations; ++i)
        solver.step();
    return solver.irradiance();
}

TEST(MovedFrames, ThatGoOnFromTheOneBeforeAreNearerToTheTruth)
{
    constexpr int kIterations = 16, kManyIterations = 256;
    const Turned first(0.0), second(3.0, 1.0f, &first);
    const auto before = first.start(1), fresh = second.start(2), going_on = second.start(2),
               long_run = second.start(3);
    after(*before, kIterations);
    going_on->go_on_from(*before, float(kIterations));
    const std::vector<glm::vec3> truth = after(*long_run, kManyIterations);
    EXPECT_LE(difference(after(*going_on, kIterations), truth),
              0.75 * difference(after(*fresh, kIterations), truth));
    EXPECT_EQ(second.resident.device.validation_messages(), "");
}

class MovedFramesOf : public testing::TestWithParam<Scheme> {};

TEST_P(MovedFramesOf, SoonForgetALampThatWentOut)
{
    const Turned lit(0.0, 1.0f, nullptr, GetParam()), dark(0.0, 0.0f, &lit, GetParam());
    const auto before = lit.start(1), now = dark.start(1);
    const double light = sum(after(*before, 64));
    now->go_on_from(*before);
    EXPECT_LE(sum(after(*now, 64)), 0.1 * light);
    EXPECT_EQ(dark.resident.device.validation_messages(), "");
}

INSTANTIATE_TEST_SUITE_P(Schemes, MovedFramesOf, testing::Values(Scheme::phased, Scheme::paper));

}  // namespace
}  // namespace lumel
