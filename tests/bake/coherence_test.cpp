// From frame to frame: what changes a little should not flicker.

#include <cmath>

#include "picture/seen.h"
#include "solve/glossy.h"
#include "solve/lumel_arrays.h"
#include "solved.h"

namespace lumel {
namespace {

constexpr int kFrameSteps = 64;

/// The glossy Cornell box with a solver at work on it.
struct Running {
    explicit Running(std::uint32_t seed)
        : world(read_gltf(support::scene_path("glossy-cornell-box"), MaterialModel::glossy),
                AtlasOptions{.size = 32}),
          near(build_near_field(world.scene, world.rays, world.lumels,
                                near_field_options({.method = "glossy"}))),
          resident(device, world.scene, world.lumels),
          solver(device, resident, world.lumels, near, {.method = "glossy", .seed = seed})
    {
        for (int i = 0; i < kFrameSteps; ++i)
            solver.step();
    }

    /// A frame with all lamps this much brighter.
    std::vector<glm::vec3> lit(float brightness)
    {
        std::vector<glm::vec3> emission = emission_of(world.lumels);
        for (glm::vec3& e : emission)
            e *= brightness;
        solver.set_emission(emission);
        for (int i = 0; i < kFrameSteps; ++i)
            solver.step();
        return solver.irradiance();
    }

    /// A frame of what a camera that was moved sideways sees reflected.
    std::vector<glm::vec3> seen(float sideways)
    {
        View view = view_of(world.scene.cameras.front());
        view.transform[3].x += sideways;
        const Surfaces surfaces(world.scene);
        const Seen points = look(view, 24, 24, 1, world.rays, surfaces);
        const std::vector<float> brightness = solver.brightness();
        solver.look_at(points.glossy, brightness,
                       {points.first, std::uint64_t(kFrameSteps) * 16, 0});
        for (int i = 0; i < kFrameSteps; ++i)
            solver.step();
        return solver.eye_radiance();
    }

    Prepared world;
    NearField near;
    gpu::Device device;
    World resident;
    GlossyIllumination solver;
};

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

TEST(Frames, ALampThatBrightensALittleLeavesTheNoiseWhereItWas)
{
    Running same(1), other(2);
    const std::vector<glm::vec3> before = same.lit(1.0f), after = same.lit(1.01f);
    EXPECT_LE(difference(after, before), 0.5 * difference(other.lit(1.0f), before));
    EXPECT_EQ(same.device.validation_messages(), "");
}

TEST(Frames, ACameraThatMovesALittleSeesTheSameNoise)
{
    Running same(1), other(2);
    const std::vector<glm::vec3> before = same.seen(0.0f), after = same.seen(1e-5f);
    EXPECT_LE(difference(after, before), 0.25 * difference(other.seen(0.0f), before));
    EXPECT_EQ(same.device.validation_messages(), "");
}

TEST(Frames, ALampOfTwiceTheLightGivesTwiceTheLight)
{
    Running running(1);
    std::vector<glm::vec3> once = running.lit(1.0f);
    for (glm::vec3& h : once)
        h *= 2.0f;
    EXPECT_LE(difference(running.lit(2.0f), once), 0.02);
}

}  // namespace
}  // namespace lumel
