// What is shown has less noise than the solution, and nothing of it gets into the solution.

#include <cmath>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "../../support/source_folder.h"
#include "links/live/live_links.h"

namespace lumel {
namespace {

using Lights = std::vector<glm::vec3>;

constexpr int kSide = 64;            // of the atlas [texels]
constexpr std::uint32_t kSeeds = 4;  // of the truth

/// The Cornell box with a second lamp, under a sky that looks in.
Scene box()
{
    Scene scene = read_gltf(support::source_path("scenes/cornell-box.gltf"));
    PunctualLight lamp{.name = "lamp", .intensity = 20.0f, .radius = 0.02f};
    lamp.transform = glm::translate(glm::mat4(1.0f), glm::vec3(0.15f, 0.4f, 0.3f));
    scene.lights.push_back(lamp);
    scene.sky = {
        .width = 16, .height = 8, .radiance = std::vector<glm::vec3>(128, glm::vec3(20.0f))};
    return scene;
}

LiveLinks live_box(std::uint32_t rays, std::uint32_t seed, bool filter = true)
{
    return {lay_out(box(), {.size = kSide}, {}), {.rays = rays, .seed = seed, .filter = filter}};
}

const auto kElsewhere = [](LiveLinks& live) {
    live.move_lamp("lamp", glm::translate(glm::mat4(1.0f), glm::vec3(0.4f, 0.2f, 0.2f)));
};
const auto kNowhere = [](LiveLinks&) {};

/// The mean of many solutions whose direct light is that of all others here.
template <class Edit>
Lights truth(const Edit& edit)
{
    Lights mean;
    for (std::uint32_t seed = 100; seed < 100 + kSeeds; ++seed) {
        LiveLinks live = live_box(256, seed, false);
        edit(live);
        live.settle();
        const Lights one = live.irradiance();
        mean.resize(one.size());
        for (std::size_t i = 0; i < one.size(); ++i)
            mean[i] += one[i] / float(kSeeds);
    }
    return mean;
}

double rmse(const Lights& values, const Lights& truth)
{
    double squares = 0.0, light = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 off(values[i] - truth[i]);
        squares += glm::dot(off, off) / 3.0;
        light += double(truth[i].r + truth[i].g + truth[i].b) / 3.0;
    }
    EXPECT_GT(light, 0.0);
    return std::sqrt(squares / double(values.size())) / (light / double(values.size()));
}

TEST(ShownFilter, HasLessNoiseThanTheSolution)
{
    const Lights right = truth(kNowhere);
    for (const std::uint32_t rays : {16u, 64u}) {
        LiveLinks live = live_box(rays, 1);
        EXPECT_TRUE(live.settle().at_rest);
        const double raw = rmse(live.irradiance(), right), shown = rmse(live.shown(), right);
        RecordProperty("raw_" + std::to_string(rays), std::to_string(raw));
        RecordProperty("shown_" + std::to_string(rays), std::to_string(shown));
        EXPECT_LT(shown, 0.6 * raw) << rays;
    }
}

/// Means over lumels that are lit, each by its own light.
struct RelativeError {
    double told = 0.0, true_one = 0.0;
};

RelativeError relative_error(const LiveLinks& live, const Lights& right)
{
    const std::vector<float> told = live.error_estimate();
    const Lights shown = live.shown();
    RelativeError mean;
    double count = 0.0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const double light = double(right[i].r + right[i].g + right[i].b) / 3.0;
        if ((live.lumels().lumels[i].flags & kLumelBuried) || !(light > 0.0))
            continue;
        const glm::dvec3 off(shown[i] - right[i]);
        mean.told += double(told[i]);
        mean.true_one += std::sqrt(glm::dot(off, off) / 3.0) / light;
        count += 1.0;
    }
    return {mean.told / count, mean.true_one / count};
}

TEST(ShownFilter, KnowsHowFarWhatIsShownIsFromTheTruth)
{
    const Lights right = truth(kNowhere);
    double coarse = 0.0;
    for (const std::uint32_t rays : {16u, 64u}) {
        LiveLinks live = live_box(rays, 1);
        for (const float part : live.error_estimate())
            ASSERT_TRUE(part == 1.0f || part == 0.0f);  // buried ones
        live.settle();
        const RelativeError error = relative_error(live, right);
        RecordProperty("told_" + std::to_string(rays), std::to_string(error.told));
        RecordProperty("true_" + std::to_string(rays), std::to_string(error.true_one));
        EXPECT_GT(error.told, 0.5 * error.true_one) << rays;
        EXPECT_LT(error.told, 2.0 * error.true_one) << rays;
        // Four times the rays halve the noise at least: they are spread evenly.
        if (coarse > 0.0) {
            EXPECT_LT(error.told, 0.6 * coarse);
        }
        coarse = error.told;
        // What is dimmed has the same part of noise, and light to come until it has followed.
        for (const char* const lamp : {"light", "lamp"})
            live.set_lamp(lamp, glm::vec3(0.25f));
        live.set_sky(glm::vec3(0.25f));
        live.advance(0.0);
        EXPECT_GT(relative_error(live, right).told, 2.0 * error.told);
        live.settle();
        EXPECT_NEAR(relative_error(live, right).told, error.told, 0.02 * error.told);
    }
}

TEST(ShownFilter, WeightsOfTheLightBeforeServeTheNext)
{
    const Lights right = truth(kElsewhere);
    LiveLinks live = live_box(64, 1);
    live.settle();
    kElsewhere(live);
    LiveLinksState state;
    while (state.sweeps < 5)
        state = live.advance(0.0);
    EXPECT_FALSE(state.at_rest);
    const double raw = rmse(live.irradiance(), right), shown = rmse(live.shown(), right);
    RecordProperty("raw", std::to_string(raw));
    RecordProperty("shown", std::to_string(shown));
    EXPECT_LT(shown, 0.8 * raw);
}

TEST(ShownFilter, IsNeverMixedIntoTheSolution)
{
    LiveLinks with = live_box(16, 1), without = live_box(16, 1, false);
    for (LiveLinks* live : {&with, &without}) {
        live->settle();
        live->set_lamp("light", glm::vec3(0.3f, 0.5f, 0.2f));
        live->settle();
        kElsewhere(*live);
        live->settle();
    }
    EXPECT_EQ(with.irradiance(), without.irradiance());
    EXPECT_EQ(without.shown(), without.irradiance());
    EXPECT_NE(with.shown(), with.irradiance());
}

TEST(ShownFilter, LeavesDirectLightSharp)
{
    LiveLinks live = live_box(16, 1);
    live.settle();  // weights of light that bounces
    EXPECT_NE(live.shown(), live.irradiance());
    live.set_sky(glm::vec3(0.0f));
    for (const char* const paint : {"white", "red", "green", "light"})
        live.set_albedo(paint, glm::vec3(0.0f));
    while (live.advance(0.0).sweeps < 1)
        ;
    EXPECT_EQ(live.shown(), live.direct());
}

TEST(ShownFilter, KeepsAllLightOfARoomThatGlowsTheSameEverywhere)
{
    LiveLinks live(
        lay_out(read_gltf(support::source_path("scenes/furnace-0.5.gltf")), {.size = 32}, {}),
        {.rays = 16});
    live.settle();
    const Lights shown = live.shown(), solved = live.irradiance();
    for (std::size_t i = 0; i < shown.size(); ++i)
        EXPECT_NEAR(shown[i].g / solved[i].g, 1.0f, 1e-2f);
}

}  // namespace
}  // namespace lumel
