// The light that a live scene shows at rest is that of a bake of the edited scene.

#include <cmath>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "base/core/error.h"
#include "links/live/live_links.h"
#include "links/trace/links.h"
#include "open_box.h"

namespace lumel {
namespace {

using Lights = std::vector<glm::vec3>;

constexpr double kTarget = 0.02;
constexpr std::uint64_t kMostRays = 384;  ///< of a bake to this target
const std::string kBlock = "short block";
const glm::mat4 kMotion = glm::translate(glm::mat4(1.0f), glm::vec3(0.04f, 0.0f, -0.05f));
constexpr glm::vec3 kPaint(0.1f, 0.2f, 0.7f), kDimmed(0.4f, 0.3f, 0.3f), kSky(0.5f, 0.6f, 0.7f);

LiveLinks live_box()
{
    return {lay_out(test::open_box(), {.size = 64}, {kBlock}), {.rays = 16, .things = {kBlock}}};
}

void edit(LiveLinks& live)
{
    live.set_lamp("light", kDimmed);
    live.set_lamp("lamp", glm::vec3(2.0f));
    live.set_sky(kSky);
    live.set_albedo("white", kPaint);
    live.move(kBlock, kMotion);
    live.settle();
}

/// The same edits in a file.
Scene edited_box()
{
    Scene scene = test::open_box();
    for (Material& material : scene.materials) {
        if (material.name == "light")
            material.emitted *= kDimmed;
        if (material.name == "white")
            material.base_color = glm::vec4(kPaint, material.base_color.a);
    }
    scene.lights[0].color *= 2.0f;
    for (glm::vec3& radiance : scene.sky.radiance)
        radiance *= kSky;
    glm::mat4& transform = scene.instances[find_instance(scene, kBlock)].transform;
    transform = kMotion * transform;
    return scene;
}

/// A bake of the edits in the atlas of a live scene.
struct Bake {
    Bake(const LiveLinks& live, std::uint32_t seed)
        : scene(edited_box(), [&](const Scene&, const RayScene&,
                                  const ProgressCallback&) { return live.atlas(); }),
          solver(scene, {.seed = seed}, {.max_shots = kMostRays, .target_error = kTarget})
    {
        while (solver.state().error < 0.0 || solver.state().error > kTarget)
            solver.step();
    }
    SolveScene scene;
    LinkRadiosity solver;
};

BakedLight bake_of(const LiveLinks& live, std::uint32_t seed)
{
    return bake_standing(live.standing(), live.lumels(), {.seed = seed}, kTarget);
}

/// RMS over lumels that are not buried, relative to the mean.
double difference(const Lights& values, const Lights& truth, const Lumels& lumels)
{
    double squares = 0.0, light = 0.0, count = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (lumels.lumels[i].flags & kLumelBuried)
            continue;
        const glm::dvec3 apart(values[i] - truth[i]);
        squares += glm::dot(apart, apart);
        light += double(truth[i].r + truth[i].g + truth[i].b);
        count += 3.0;
    }
    return std::sqrt(squares / count) / (light / count);
}

TEST(BakedLight, AfterEditsIsThatOfABakeOfTheEditedScene)
{
    LiveLinks live = live_box();
    edit(live);
    const Lights by_links = live.shown();
    live.show(bake_of(live, 1));
    ASSERT_TRUE(live.baked());
    Bake same(live, 1), other(live, 2);
    EXPECT_EQ(live.shown(), same.solver.irradiance());
    EXPECT_EQ(live.baked()->error, same.solver.state().error);
    const Lumels lumels = live.shown_lumels();
    const double errors = live.baked()->error + other.solver.state().error;
    EXPECT_LE(difference(live.shown(), other.solver.irradiance(), lumels), errors);
    EXPECT_GT(difference(live.shown(), by_links, lumels), 0.0);
    std::size_t buried = 0;
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i) {
        EXPECT_EQ(lumels.lumels[i].flags, same.scene.lumels.lumels[i].flags) << i;
        buried += lumels.lumels[i].flags != live.lumels().lumels[i].flags;
    }
    EXPECT_GT(buried, 0u) << "under the block";
}

TEST(BakedLight, ShowsUntilTheNextEdit)
{
    LiveLinks live = live_box();
    live.settle();
    const BakedLight light = bake_of(live, 1);
    const auto expect_dropped_by = [&](const auto& change) {
        live.show(light);
        EXPECT_EQ(live.shown(), light.irradiance);
        change();
        EXPECT_FALSE(live.baked());
        EXPECT_NE(live.shown(), light.irradiance);
        live.settle();
        EXPECT_FALSE(live.baked());
    };
    expect_dropped_by([&] { live.set_lamp("light", kDimmed); });
    expect_dropped_by([&] { live.set_sky(kSky); });
    expect_dropped_by([&] { live.turn_sky(1.0); });
    expect_dropped_by([&] { live.set_albedo("white", kPaint); });
    expect_dropped_by([&] { live.move_lamp("lamp", glm::mat4(1.0f)); });
    expect_dropped_by([&] { live.request(0, kMotion); });
    live.show(light);
    live.set_lamp("light", kDimmed);  // as it is
    live.request(0, kMotion);
    live.settle();
    EXPECT_TRUE(live.baked());
}

/// Of a lumel, as the error of all is of them.
TEST(BakedLight, KnowsTheErrorOfItsLumels)
{
    LiveLinks live = live_box();
    live.settle();
    live.show(bake_of(live, 1));
    const Lights light = live.shown();
    const std::vector<float> error = live.error_estimate();
    const Lumels lumels = live.shown_lumels();
    double squares = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        if (lumels.lumels[i].flags & kLumelBuried)
            continue;
        const double all = double(light[i].r + light[i].g + light[i].b);
        squares += std::pow(double(error[i]) * all, 2.0);
        sum += all;
        count += 1.0;
    }
    EXPECT_NEAR(std::sqrt(squares / count) / (sum / count) / live.baked()->error, 1.0, 0.25);
}

TEST(BakedLight, AsideThatIsStoppedHasNone)
{
    LiveLinks live = live_box();
    live.settle();
    BakeAside stopped(live.standing(), live.lumels(), {.seed = 1}, 1e-4);
    EXPECT_FALSE(stopped.has_ended(std::chrono::milliseconds(0)));
    stopped.stop();
    EXPECT_FALSE(stopped.take());
    BakeAside whole(live.standing(), live.lumels(), {.seed = 1}, kTarget);
    live.set_lamp("light", glm::vec3(0.0f));  // later than the bake's copy of the scene
    live.settle();
    const std::optional<BakedLight> light = whole.take();
    ASSERT_TRUE(light);
    LiveLinks other = live_box();
    other.settle();
    EXPECT_EQ(light->irradiance, bake_of(other, 1).irradiance);
}

TEST(BakedLight, OfARoomWithoutAbsorptionIsRefused)
{
    Scene scene = read_gltf(support::source_path("scenes/furnace-0.9.gltf"));
    scene.max_albedo = 1.0f;
    LiveLinks live(lay_out(std::move(scene), {.size = 32}, {}), {.rays = 16});
    live.set_albedo(0, glm::vec3(1.0f));
    BakeAside aside(live.standing(), live.lumels(), {.seed = 1}, kTarget);
    EXPECT_THROW(aside.take(), Error);
}

}  // namespace
}  // namespace lumel
