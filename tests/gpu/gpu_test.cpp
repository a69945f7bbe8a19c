// The thin layer over Vulkan.

#include <numeric>

#include <gtest/gtest.h>

#include "gpu/pacer.h"
#include "tests/gpu/twice.comp.h"
#include "tests/gpu/weigh.comp.h"

namespace lumel::gpu {
namespace {

TEST(Device, ThereIsAUsableOne)
{
    const std::vector<DeviceInfo> devices = list_devices();
    ASSERT_FALSE(devices.empty());
    EXPECT_TRUE(std::any_of(devices.begin(), devices.end(), [](auto& d) { return d.usable; }));
}

TEST(Device, AWrongPickIsRefusedWithTheList)
{
    try {
        const Device device("no such device");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::device);
        EXPECT_NE(std::string(error.what()).find(list_devices()[0].name), std::string::npos);
    }
}

TEST(Device, OfAHostServesAndStaysTheHosts)
{
    const Device host;
    const HostDevice handles{.instance = host.instance(),
                             .physical = host.physical(),
                             .device = host.handle(),
                             .queue = host.queue(),
                             .queue_family = host.queue_family()};
    const std::vector<std::uint32_t> values = {3, 1, 4, 1, 5};
    {
        const Device guest(handles);
        EXPECT_EQ(guest.info().name, host.info().name);
        const Array<std::uint32_t> array(guest, std::span<const std::uint32_t>(values));
        EXPECT_EQ(array.download(), values);
    }
    const Array<std::uint32_t> after(host, std::span<const std::uint32_t>(values));
    EXPECT_EQ(after.download(), values);
    EXPECT_THROW(Device(HostDevice{}), Error);
    EXPECT_EQ(host.validation_messages(), "");
}

TEST(Array, ComesBackAsItWent)
{
    const Device device;
    std::vector<std::uint32_t> values(1000);
    std::iota(values.begin(), values.end(), 0u);
    const Array<std::uint32_t> array(device, std::span<const std::uint32_t>(values));
    EXPECT_EQ(array.download(), values);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(Array, LargerThanTheDeviceAllowsSaysSo)
{
    const Device device;
    EXPECT_THROW(Array<std::uint32_t>(device, device.max_array_bytes() / 4 + 1), Error);
}

TEST(Commands, RunInTheOrderRecorded)
{
    const Device device;
    const Kernel<shaders::Twice> twice(device);
    const Array<std::uint32_t> array(device, 100);
    Commands commands(device);
    commands.fill(array.buffer(), 0);
    for (std::uint32_t added : {1u, 0u, 3u})
        commands.dispatch(twice, {.values = array}, {0, 100, added}, 100);
    commands.run();
    for (const std::uint32_t value : array.download())
        EXPECT_EQ(value, 7u);  // ((0·2 + 1)·2 + 0)·2 + 3
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(Kernel, GetsEachArrayByItsName)
{
    const Device device;
    const Kernel<shaders::Weigh> weigh(device);
    const std::vector<Colored> given = {{.color = {1.0f, 2.0f, 3.0f}, .place = 2},
                                        {.color = {4.0f, 5.0f, 6.0f}, .place = 0},
                                        {.color = {7.0f, 8.0f, 9.0f}, .place = 1}};
    const Array<Colored> values(device, std::span<const Colored>(given));
    const Array<float> weights(device, std::array{1.0f, 10.0f, 100.0f});
    const Array<glm::vec3> result(device, given.size());
    Commands commands(device);
    commands.dispatch(weigh, {.weights = weights, .values = values, .result = result},
                      {std::uint32_t(given.size())}, given.size());
    commands.run();
    EXPECT_EQ(result.download(),
              (std::vector<glm::vec3>{
                  {40.0f, 50.0f, 60.0f}, {700.0f, 800.0f, 900.0f}, {1.0f, 2.0f, 3.0f}}));
    EXPECT_EQ(device.validation_messages(), "");
}

// Some drivers write timestamps late once something was drawn.
TEST(Commands, TimeEachStageByItsOwnWork)
{
    const Device device;
    const Kernel<shaders::Twice> twice(device);
    constexpr std::uint32_t count = 4000000;
    const Array<std::uint32_t> array(device, count);
    const Target depth(device, Pixel::depth, 64, 64);
    Commands commands(device);
    const auto draw = [&] {
        commands.begin_pass(nullptr, depth, {0, 0, 64, 64});
        commands.end_pass();
    };
    const auto work = [&] { commands.dispatch(twice, {.values = array}, {0, count, 1}, count); };
    work();  // the driver compiles what it meets for the first time
    draw();
    commands.run();
    commands.take_times();
    commands.stage("drawing");
    draw();
    commands.stage("working");
    work();
    commands.stage("drawing again");
    draw();
    commands.run();
    const StageTimes times = commands.take_times();
    EXPECT_GT(times.at("working"), times.at("drawing"));
    EXPECT_GT(times.at("working"), times.at("drawing again"));
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(Pacer, CutsWorkWithoutChangingItsResult)
{
    const Device device;
    const Kernel<shaders::Twice> twice(device);
    constexpr std::uint32_t count = 1000000;
    const Array<std::uint32_t> array(device, count);
    Pacer pacer(device, 0.5);  // below what all of it takes at once
    pacer.work("clear", [&](Commands& commands) { commands.fill(array.buffer(), 5); });
    for (int round = 0; round < 3; ++round)
        pacer.work("twice", count, 65536,
                   [&](Commands& commands, std::uint32_t first, std::uint32_t last) {
                       commands.dispatch(twice, {.values = array}, {first, last, 1}, last - first);
                   });
    pacer.finish();
    EXPECT_GT(pacer.submissions(), 4u);
    for (const std::uint32_t value : array.download())
        ASSERT_EQ(value, 47u);  // 5 → 11 → 23 → 47
    EXPECT_GT(pacer.times().at("twice"), 0.0);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(Target, ComesBackAsItWent)
{
    const Device device;
    Target target(device, Pixel::rgba32, 4, 4, 3);
    std::vector<float> pixels(64, 0.25f);
    target.upload(pixels.data());
    std::vector<float> back(64);
    target.download(back.data());
    EXPECT_EQ(back, pixels);
    EXPECT_EQ(device.validation_messages(), "");
}

}  // namespace
}  // namespace lumel::gpu
