// A moved scene is lit as one that always stood so.

#include <cmath>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "live/live_scene.h"
#include "scene/scene.h"

namespace lumel {
namespace {

constexpr int kSide = 48;  // of the atlas [texels]

Scene cornell()
{
    return read_gltf(LUMEL_SOURCE_DIR "/scenes/cornell-box.gltf");
}

std::uint32_t index_of(const Scene& scene, const std::string& name)
{
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (scene.instances[i].name == name)
            return i;
    throw std::runtime_error("no instance " + name);
}

LiveOptions options_for(const Scene& scene)
{
    LiveOptions options;
    options.atlas.size = kSide;
    options.movers = {index_of(scene, "short block")};
    return options;
}

/// The short block's place, shifted along the floor and turned about its own axis.
glm::mat4 shifted(const Scene& scene, float way, float angle)
{
    const glm::vec3 axis(0.186f, 0.0f, 0.168f);
    const glm::mat4 shift = glm::translate(glm::mat4(1.0f), glm::vec3(-way, 0.0f, 0.5f * way));
    return shift *
           glm::translate(
               glm::rotate(glm::translate(glm::mat4(1.0f), axis), angle, glm::vec3(0, 1, 0)),
               -axis) *
           scene.instances[index_of(scene, "short block")].transform;
}

/// Relative RMSE over lumels that are not buried.
double apart(const LiveScene& scene, const std::vector<glm::vec3>& values,
             const std::vector<glm::vec3>& truth)
{
    double square = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (scene.lumels().lumels[i].flags & kLumelBuried)
            continue;
        const glm::dvec3 d = glm::dvec3(values[i]) - glm::dvec3(truth[i]);
        square += glm::dot(d, d);
        sum += double(truth[i].r) + double(truth[i].g) + double(truth[i].b);
        count += 3.0;
    }
    return std::sqrt(square / count) / (sum / count);
}

TEST(LiveScene, AfterAMoveIsLitAsIfItAlwaysStoodSo)
{
    const gpu::Device device;
    const Scene scene = cornell();
    const LiveOptions options = options_for(scene);
    const std::uint32_t block = options.movers[0];
    const glm::mat4 place = shifted(scene, 0.1f, 0.5f);

    LiveScene moved(device, scene, options);
    moved.settle();
    const auto first = moved.irradiance();
    moved.move(block, place);
    moved.settle();

    LiveScene fresh(device, scene, options);
    fresh.move(block, place);  // before anything is shot
    fresh.settle();
    const auto truth = fresh.irradiance();
    EXPECT_GT(apart(fresh, first, truth), 0.03);  // it did make a difference
    EXPECT_LE(apart(fresh, moved.irradiance(), truth), 0.01);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(LiveScene, MovedThereAndBackIsAsBefore)
{
    const gpu::Device device;
    const Scene scene = cornell();
    const LiveOptions options = options_for(scene);
    const std::uint32_t block = options.movers[0];
    LiveScene live(device, scene, options);
    live.settle();
    const auto first = live.irradiance();
    for (int turn = 0; turn < 3; ++turn) {
        live.move(block, shifted(scene, 0.1f, 0.5f));
        live.settle();
        live.move(block, scene.instances[block].transform);
        live.settle();
    }
    EXPECT_EQ(device.validation_messages(), "");
}

}  // namespace
}  // namespace lumel
