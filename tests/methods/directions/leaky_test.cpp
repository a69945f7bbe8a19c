// A leaky mean along directions follows what changes, and forgets what was.

#include <cmath>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "../../support/source_folder.h"
#include "base/core/error.h"
#include "methods/directions/leaky_scene.h"
#include "scene/sky/light_options.h"
#include "scene/values/scene.h"

namespace lumel {
namespace {

constexpr const char* kCube = "white cube";
/// The last 1 / leak directions count: their noise stays, in means over all lumels too.
constexpr double kNoise = 0.03;

Scene cubes_under_a_sky()
{
    Scene scene = read_gltf(support::source_path("scenes/four-cubes.gltf"));
    add_lights(scene, {.sky_color = glm::vec3(1.0f)});
    return scene;
}

LeakyOptions options_for(const Scene& scene)
{
    LeakyOptions options;
    options.atlas.size = 32;
    options.solver.map_side = 128;
    options.movers = {find_instance(scene, kCube)};
    return options;
}

double mean_of(LeakyScene& scene, std::uint32_t instance)
{
    double sum = 0.0, count = 0.0;
    const std::vector<glm::vec3> light = scene.irradiance();
    for (std::size_t i = 0; i < light.size(); ++i)
        if (scene.lumels().lumels[i].instance == instance) {
            sum += double(light[i].g);
            count += 1.0;
        }
    return sum / count;
}

glm::mat4 shifted(const Scene& scene, const glm::vec3& by)
{
    return glm::translate(glm::mat4(1.0f), by) *
           scene.instances[find_instance(scene, kCube)].transform;
}

TEST(LeakyScene, DimsWithTheSky)
{
    const gpu::Device device;
    const Scene scene = cubes_under_a_sky();
    const std::uint32_t slab = find_instance(scene, "slab");
    LeakyScene live(device, scene, options_for(scene));
    live.settle();
    const double before = mean_of(live, slab);
    live.set_sky(glm::vec3(0.25f));
    const LiveState begun = live.update(0.0);
    EXPECT_FALSE(begun.at_rest);
    EXPECT_GT(mean_of(live, slab), 0.5 * before);  // it has not followed yet
    EXPECT_TRUE(live.settle().at_rest);
    EXPECT_NEAR(mean_of(live, slab) / before, 0.25, 0.25 * kNoise);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(LeakyScene, AnUpdateWithoutTimeDrawsOneBatchAndAtRestNone)
{
    const gpu::Device device;
    const Scene scene = cubes_under_a_sky();
    LeakyScene live(device, scene, options_for(scene));
    EXPECT_EQ(live.update(0.0).hemicubes, std::uint64_t(LeakyOptions{}.solver.batch));
    const LiveState rest = live.settle();
    // 0.99ⁿ is below 0.2 %.
    EXPECT_GE(rest.hemicubes, 619u);
    EXPECT_EQ(live.update(1000.0).hemicubes, rest.hemicubes);
    EXPECT_EQ(device.validation_messages(), "");
}

// The slab gets the light back that a cube kept from it.
TEST(LeakyScene, AMovedCubeIsLitAsIfItAlwaysStoodSo)
{
    const gpu::Device device;
    const Scene scene = cubes_under_a_sky();
    const std::uint32_t cube = find_instance(scene, kCube), slab = find_instance(scene, "slab");
    LeakyScene live(device, scene, options_for(scene));
    live.settle();
    const double before = mean_of(live, slab);
    for (const glm::vec3& by : {glm::vec3(0.0f, 2.0f, 0.0f), glm::vec3(0.0f, 0.3f, 0.0f)}) {
        live.move(cube, shifted(scene, by));
        live.settle();
        Scene posed = scene;
        posed.instances[cube].transform = shifted(scene, by);
        LeakyScene fresh(device, posed, options_for(posed));
        fresh.settle();
        EXPECT_NEAR(mean_of(live, slab) / mean_of(fresh, slab), 1.0, kNoise);
        EXPECT_NEAR(mean_of(live, cube) / mean_of(fresh, cube), 1.0, kNoise);
        EXPECT_GT(mean_of(fresh, slab), before);
    }
    EXPECT_EQ(device.validation_messages(), "");
}

// Nothing of it is left in the box that held the scene at first.
TEST(LeakyScene, TheWholeSceneMovedAwayIsLitAsBefore)
{
    const gpu::Device device;
    const Scene scene = cubes_under_a_sky();
    const std::uint32_t slab = find_instance(scene, "slab");
    LeakyOptions options = options_for(scene);
    options.movers = {};
    LeakyScene live(device, scene, options);
    live.settle();
    const double before = mean_of(live, slab);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        live.move(i, glm::translate(glm::mat4(1.0f), glm::vec3(10.0f, 0.0f, 0.0f)) *
                         scene.instances[i].transform);
    live.settle();
    EXPECT_NEAR(mean_of(live, slab) / before, 1.0, kNoise);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(LeakyScene, PaintCountsForWhatIsReflected)
{
    const gpu::Device device;
    const Scene scene = cubes_under_a_sky();
    const std::uint32_t slab = find_instance(scene, "slab");
    const std::uint32_t cube = find_instance(scene, "orange cube");
    LeakyScene live(device, scene, options_for(scene));
    live.settle();
    const double before = mean_of(live, cube);
    live.set_reflectance(slab, glm::vec3(0.0f));
    live.settle();
    EXPECT_LT(mean_of(live, cube), (1.0 - 2.0 * kNoise) * before);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(LeakyScene, RefusesWhatIsNotThere)
{
    const gpu::Device device;
    const Scene scene = cubes_under_a_sky();
    LeakyScene live(device, scene, options_for(scene));
    EXPECT_THROW(live.move(find_instance(scene, "slab"), glm::mat4(1.0f)), Error);
    EXPECT_THROW(live.move(find_instance(scene, kCube), glm::mat4(2.0f)), Error);
    EXPECT_THROW(live.set_emission(99, glm::vec3(1.0f)), Error);
    EXPECT_THROW(live.set_sky(glm::vec3(-1.0f)), Error);
    EXPECT_THROW(live.set_light(0, glm::vec3(1.0f)), Error);
}

}  // namespace
}  // namespace lumel
