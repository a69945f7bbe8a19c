// The thin layer over Vulkan.

#include <cstdlib>
#include <numeric>

#include <gtest/gtest.h>

#include "gpu/memory.h"
#include "gpu/pacer.h"
#include "tests/gpu/twice.comp.h"
#include "tests/gpu/weigh.comp.h"

namespace lumel::gpu {
namespace {

/// A host's instance and device with no more than HostDevice asks for: no VK_EXT_debug_utils.
class PlainHost {
public:
    PlainHost()
    {
        check(volkInitialize(), "volkInitialize");
        const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                            .apiVersion = VK_API_VERSION_1_3};
        const VkInstanceCreateInfo instance{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                            .pApplicationInfo = &application};
        check(vkCreateInstance(&instance, nullptr, &handles_.instance), "vkCreateInstance");
        volkLoadInstance(handles_.instance);
        std::uint32_t one = 1;
        vkEnumeratePhysicalDevices(handles_.instance, &one, &handles_.physical);
        VkPhysicalDeviceVulkan13Features v13{
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
            .synchronization2 = VK_TRUE,
            .dynamicRendering = VK_TRUE,
            .maintenance4 = VK_TRUE};
        const VkPhysicalDeviceVulkan12Features v12{
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
            .pNext = &v13,
            .scalarBlockLayout = VK_TRUE};
        const VkPhysicalDeviceFeatures features{.fullDrawIndexUint32 = VK_TRUE};
        const float priority = 1.0f;
        const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                            .queueCount = 1,
                                            .pQueuePriorities = &priority};
        const char* extension = VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME;
        const VkDeviceCreateInfo device{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                        .pNext = &v12,
                                        .queueCreateInfoCount = 1,
                                        .pQueueCreateInfos = &queue,
                                        .enabledExtensionCount = 1,
                                        .ppEnabledExtensionNames = &extension,
                                        .pEnabledFeatures = &features};
        check(vkCreateDevice(handles_.physical, &device, nullptr, &handles_.device),
              "vkCreateDevice");
        volkLoadDevice(handles_.device);
        vkGetDeviceQueue(handles_.device, 0, 0, &handles_.queue);
    }
    ~PlainHost()
    {
        vkDestroyDevice(handles_.device, nullptr);
        vkDestroyInstance(handles_.instance, nullptr);
    }
    PlainHost(const PlainHost&) = delete;
    PlainHost& operator=(const PlainHost&) = delete;

    const HostDevice& handles() const { return handles_; }

private:
    HostDevice handles_;
};

TEST(Device, ThereIsAUsableOne)
{
    const std::vector<DeviceInfo> devices = list_devices();
    ASSERT_FALSE(devices.empty());
    EXPECT_TRUE(std::any_of(devices.begin(), devices.end(), [](auto& d) { return d.usable; }));
}

TEST(Device, HasFreeMemory)
{
    for (const DeviceInfo& info : list_devices()) {
        EXPECT_GT(info.free_bytes, 0u) << info.name;
        EXPECT_LE(info.free_bytes, info.memory_bytes) << info.name;
    }
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

TEST(Device, OfAHostNeedsNoDebugUtils)
{
    const PlainHost host;
    const Device guest(host.handles());
    const std::vector<std::uint32_t> values = {2, 7, 1, 8};
    const Array<std::uint32_t> array(guest, std::span<const std::uint32_t>(values), "named");
    Target image(guest, Pixel::rgba8, 2, 2);
    image.upload(values.data());
    Pacer pacer(guest);
    pacer.work("labelled", [&](Commands& commands) { commands.fill(array.buffer(), 3); });
    pacer.finish();
    EXPECT_EQ(array.download(), std::vector<std::uint32_t>(4, 3));
}

TEST(Device, HasWhatItsArraysHold)
{
    const Device device;
    const std::uint64_t before = device.held_bytes();
    {
        const Array<std::uint32_t> array(device, 1000);
        EXPECT_GE(device.held_bytes(), before + 4000);
    }
    EXPECT_EQ(device.held_bytes(), before);
    EXPECT_GE(device.peak_bytes(), before + 4000);
}

TEST(Device, ThatIsLostDoesNotLackMemory)
{
    for (const VkResult lack : {VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_OUT_OF_HOST_MEMORY})
        EXPECT_THROW(check(lack, "call"), OutOfMemory);
    for (const VkResult other : {VK_ERROR_DEVICE_LOST, VK_ERROR_INITIALIZATION_FAILED})
        try {
            check(other, "call");
            FAIL() << other;
        } catch (const OutOfMemory&) {
            FAIL() << other;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::device);
        }
}

TEST(Array, SharesMemoryWithOthersButNoByte)
{
    const Device device;
    std::vector<Array<std::uint32_t>> arrays;
    const auto values_of = [](std::size_t i) {
        return std::vector<std::uint32_t>(1 + 97 * i, std::uint32_t(i));
    };
    for (std::size_t i = 0; i < 400; ++i) {
        arrays.emplace_back(device, std::span<const std::uint32_t>(values_of(i)));
        if (i % 3 == 2)  // gaps of many sizes to be filled again
            arrays.erase(arrays.begin() + std::ptrdiff_t(arrays.size() / 2));
    }
    EXPECT_LT(device.memory().blocks(), 4u);
    for (const Array<std::uint32_t>& array : arrays) {
        const std::vector<std::uint32_t> back = array.download();
        EXPECT_EQ(back, values_of((back.size() - 1) / 97));
    }
    const std::size_t blocks = device.memory().blocks();
    arrays.clear();
    EXPECT_LT(device.memory().blocks(), blocks);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(Array, OfManyPartsComesBackAsItWent)
{
    const Device device;
    std::vector<std::uint32_t> values(5'000'001);
    std::iota(values.begin(), values.end(), 7u);
    const Array<std::uint32_t> array(device, std::span<const std::uint32_t>(values));
    EXPECT_EQ(array.download(), values);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(Names, StandInValidationMessages)
{
    const Device device;
    if (std::getenv("LUMEL_VALIDATION") == nullptr)
        GTEST_SKIP() << "needs the validation layers";
    const Array<std::uint32_t> few(device, 1, "sums of light"), many(device, 100);
    Commands commands(device);
    commands.stage("adding up");
    commands.copy(many.buffer(), few.buffer(), 400);
    const std::string messages = device.validation_messages();
    EXPECT_NE(messages.find("sums of light"), std::string::npos) << messages;
    EXPECT_NE(messages.find("adding up"), std::string::npos) << messages;
}

TEST(Names, AreTheLineOfSourceWhereNoneIsGiven)
{
    EXPECT_EQ(Name::of_line().text(), "gpu_test.cpp:" + std::to_string(__LINE__));
    EXPECT_EQ(Name::of_line("/home/me/src/lumel/src/methods/glossy/glossy.cpp", 7).text(),
              "methods/glossy/glossy.cpp:7");
    EXPECT_EQ(Name("sums").text(), "sums");
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
    EXPECT_THROW(Array<std::uint32_t>(device, device.max_array_bytes() / 4 + 1), OutOfMemory);
}

TEST(Memory, LargerThanTheLargestHeapIsRefusedBeforeTheDriverIsAsked)
{
    const Device device;
    VkPhysicalDeviceMemoryProperties properties;
    vkGetPhysicalDeviceMemoryProperties(device.physical(), &properties);
    std::uint64_t largest = 0;
    for (std::uint32_t i = 0; i < properties.memoryHeapCount; ++i)
        largest = std::max(largest, properties.memoryHeaps[i].size);
    const VkMemoryRequirements too_much{largest + 1, 1, ~0u};
    for (const MemoryUse use : {MemoryUse::array, MemoryUse::image, MemoryUse::host})
        EXPECT_THROW(device.memory().take(too_much, use, "too much"), OutOfMemory);
    EXPECT_EQ(device.validation_messages(), "");
}

TEST(Array, PartsAreWrittenAlone)
{
    const Device device;
    Array<std::uint32_t> array(device, std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
    array.upload_part(2, std::vector<std::uint32_t>{12, 13});
    EXPECT_EQ(array.download(), (std::vector<std::uint32_t>{0, 1, 12, 13, 4, 5}));
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

TEST(Target, RowsAreWrittenAlone)
{
    const Device device;
    constexpr std::uint32_t kWidth = 3, kHeight = 5, kRow = 4 * kWidth;
    Target target(device, Pixel::rgba32, kWidth, kHeight);
    std::vector<float> pixels(kRow * kHeight, 1.0f);
    target.upload(pixels.data());
    const std::vector<float> rows(kRow * 2, 7.0f);
    target.upload_rows(rows.data(), 2, 2);
    std::vector<float> back(pixels.size());
    target.download(back.data());
    std::copy(rows.begin(), rows.end(), pixels.begin() + 2 * kRow);
    EXPECT_EQ(back, pixels);
}

TEST(Target, OfManyPartsComesBackAsItWent)
{
    const Device device;
    Target target(device, Pixel::rgba32, 1001, 701);
    std::vector<float> pixels(std::size_t(1001) * 701 * 4);
    std::iota(pixels.begin(), pixels.end(), 0.0f);
    target.upload(pixels.data());
    std::vector<float> back(pixels.size());
    target.download(back.data());
    EXPECT_EQ(back, pixels);
    EXPECT_EQ(device.validation_messages(), "");
}

}  // namespace
}  // namespace lumel::gpu
