// Scenes kept lit by a host.

#include <limits>

#include <gtest/gtest.h>

#include "boxes.h"
#include "gpu/device.h"
#include "lumel/vulkan.h"

namespace lumel::v0 {
namespace {

using namespace test;

constexpr double kResidual = 0.01;

LiveSettings settings_for(const Scene& scene)
{
    return {
        .atlas = {.size = kSize}, .movers = {scene.find_instance("box")}, .residual = kResidual};
}

TEST(LiveScenes, AreAsBrightAsTheirLamps)
{
    const Device device;
    const Scene scene = Scene::load(scene_path("moving-large-lamp"));
    LiveScene live(device, scene, settings_for(scene));
    EXPECT_TRUE(live.update(kUntilAtRest).at_rest);
    const double bright = mean_of(live.map());
    for (std::uint32_t i = 0; i < scene.instances().size(); ++i)
        live.set_emission(i, {2.0f, 2.0f, 2.0f});
    EXPECT_TRUE(live.update(kUntilAtRest).at_rest);
    EXPECT_NEAR(mean_of(live.map()), 2.0 * bright, 2.0 * kResidual * bright);
    EXPECT_EQ(live.surfaces().size(), scene.instances().size());
}

TEST(LiveScenes, RefuseWhatTheyCannotFollow)
{
    const Device device;
    const Scene scene = Scene::load(scene_path("moving-large-lamp"));
    const std::uint32_t box = scene.find_instance("box");
    LiveScene live(device, scene, settings_for(scene));
    Mat4 stretched = scene.instances()[box].transform;
    stretched[0] *= 2.0f;
    Mat4 nowhere = scene.instances()[box].transform;
    nowhere[12] = std::numeric_limits<float>::quiet_NaN();
    expect_error(ErrorKind::input, {"stretched"}, [&] { live.move(box, stretched); });
    expect_error(ErrorKind::input, {"not finite"}, [&] { live.move(box, nowhere); });
    expect_error(ErrorKind::input, {"instance 99"}, [&] { live.move(99, kIdentity); });
    expect_error(ErrorKind::input, {"emission"}, [&] { live.set_emission(box, {-1, 0, 0}); });
    expect_error(ErrorKind::input, {"light 0"}, [&] { live.set_light(0, {1, 1, 1}); });
    expect_error(ErrorKind::input, {"sky"}, [&] { live.set_sky({1, 1, 1}); });
    LiveSettings settings = settings_for(scene);
    settings.movers = {99};
    expect_error(ErrorKind::input, {"99"}, [&] { LiveScene(device, scene, settings); });
    settings = settings_for(scene);
    settings.residual = 0.0;
    expect_error(ErrorKind::input, {"residual"}, [&] { LiveScene(device, scene, settings); });
}

TEST(LiveScenes, ShowTheirMapOnTheDeviceOfTheHost)
{
    const gpu::Device host;
    const Device device = use_device({.instance = host.instance(),
                                      .physical = host.physical(),
                                      .device = host.handle(),
                                      .queue = host.queue(),
                                      .queue_family = host.queue_family()});
    const Scene scene = Scene::load(scene_path("moving-large-lamp"));
    LiveScene live(device, scene, settings_for(scene));
    live.update(0.0);
    const DeviceImage image = device_image(live);
    EXPECT_NE(image.image, VkImage(VK_NULL_HANDLE));
    EXPECT_NE(image.view, VkImageView(VK_NULL_HANDLE));
    EXPECT_EQ(image.format, VK_FORMAT_R32G32B32A32_SFLOAT);
    EXPECT_EQ(image.width, std::uint32_t(kSize));
    EXPECT_EQ(image.height, std::uint32_t(kSize));
    expect_error(ErrorKind::device, {"null"}, [] { use_device({}); });
}

}  // namespace
}  // namespace lumel::v0
