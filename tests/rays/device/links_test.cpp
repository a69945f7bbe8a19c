// Links whose rays a device casts, against those of the host and against a closed form.

#include <sstream>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "../../jobs/closed_room.h"
#include "../../support/closed_forms.h"
#include "base/core/log.h"
#include "base/core/state_bytes.h"
#include "compared_links.h"
#include "links/sweeps/device_sweeps.h"
#include "links/trace/links.h"

namespace lumel {
namespace {

class LinksByDevice : public support::ByDeviceRays {
protected:
    SolverOptions links(double error) const
    {
        return {.method = LinksOptions{.rays = GetParam().option}, .target_error = error};
    }
};

INSTANTIATE_TEST_SUITE_P(Of, LinksByDevice, testing::ValuesIn(support::kDeviceRays),
                         support::name_of_rays);

using RoomByDevice = std::tuple<support::ComparedRoom, support::DeviceRays>;

class LinksInRoomsByDevice : public support::OnDevice,
                             public testing::WithParamInterface<RoomByDevice> {
protected:
    void SetUp() override { need(std::get<support::DeviceRays>(GetParam())); }
};

std::string name_of_both(const testing::TestParamInfo<RoomByDevice>& test)
{
    const auto& [room, rays] = test.param;
    return fmt::format("{}_{}", room.name, rays.name);
}

INSTANTIATE_TEST_SUITE_P(Of, LinksInRoomsByDevice,
                         testing::Combine(testing::ValuesIn(support::kComparedRooms),
                                          testing::ValuesIn(support::kDeviceRays)),
                         name_of_both);

TEST_P(LinksInRoomsByDevice, LightAsTheHostDoes)
{
    const auto& [room, rays] = GetParam();
    support::expect_agreement(room, {.rays = rays.option}, {.rays = Rays::host}, 0.02);
}

TEST_P(LinksByDevice, MakeAClosedRoomGlowAsItsAbsorptionAllows)
{
    constexpr float kAlbedo = 0.9f;
    const double truth = furnace_irradiance(1.0, double(kAlbedo));
    EXPECT_NEAR(support::mean_in_closed_room(kAlbedo, links(0.02)), truth, 0.01 * truth);
}

TEST_P(LinksByDevice, GiveTheSameBytesAgain)
{
    const SolveScene world(support::scene_path("cornell-box"), {.size = 32});
    const SolverOptions options = links(0.05);
    EXPECT_EQ(support::solve_scene(world, options).irradiance,
              support::solve_scene(world, options).irradiance);
}

TEST_P(LinksByDevice, AreSweptOnTheCpuWhereTheDeviceLacksMemory)
{
    const SolveScene world(support::scene_path("cornell-box"), {.size = 32});
    const auto light = [&](std::uint64_t most) {
        SolverOptions options = links(0.05);
        options.max_device_bytes = most;
        return support::solve_scene(world, options).irradiance;
    };
    const LogCapture log;
    const auto on_device = light(0);
    EXPECT_TRUE(log.messages().empty());
    // Enough for nothing, for a part of the first round's links, and for all of these.
    const auto least = double(DeviceSweeps::bytes(world.lumels.lumels.size()));
    for (const double most : {1.0, 1.5 * least, 2.5 * least})
        EXPECT_EQ(light(std::uint64_t(most)), on_device) << most;
    EXPECT_GE(log.messages().size(), 2u);
    for (const std::string& message : log.messages())
        EXPECT_NE(message.find("sweeping on the CPU"), std::string::npos) << message;
}

/// The device is lost as long as this lives: submissions to it fail.
class LostDevice {
public:
    LostDevice()
        : submit_(std::exchange(vkQueueSubmit2,
                                [](VkQueue, std::uint32_t, const VkSubmitInfo2*,
                                   VkFence) -> VkResult { return VK_ERROR_DEVICE_LOST; }))
    {
    }
    ~LostDevice() { vkQueueSubmit2 = submit_; }
    LostDevice(const LostDevice&) = delete;
    LostDevice& operator=(const LostDevice&) = delete;

private:
    PFN_vkQueueSubmit2 submit_;
};

std::string error_of_step(Solver& solver)
{
    try {
        solver.step();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST_P(LinksByDevice, EndWhereTheDeviceIsLostAndGoOnFromTheStepBefore)
{
    const SolveScene world(support::scene_path("cornell-box"), {.size = 32});
    const LinksOptions options{.rays = GetParam().option};
    LinkRadiosity undisturbed(&device, world, options, {}, Parts::all),
        lost(&device, world, options, {}, Parts::all),
        resumed(&device, world, options, {}, Parts::all);
    // The last step sweeps.
    while (undisturbed.state().shots == 0)
        undisturbed.step();
    while (lost.state().iterations + 1 < undisturbed.state().iterations)
        lost.step();
    std::stringstream kept;
    StateWriter writer(kept);
    lost.write_state(writer);
    writer.finish();
    {
        const LostDevice loss;
        const LogCapture log;
        EXPECT_NE(error_of_step(lost).find("the graphics device was lost"), std::string::npos);
        EXPECT_TRUE(log.messages().empty()) << log.messages()[0];
    }
    StateReader reader(kept, kept.str().size(), "state");
    resumed.read_state(reader);
    reader.finish();
    resumed.step();
    EXPECT_EQ(resumed.irradiance(), undisturbed.irradiance());
}

/// GPU memory of sweeps and of links.
std::uint64_t bytes_of_sweeps(const gpu::Device& device)
{
    std::uint64_t bytes = 0;
    for (const gpu::Holding& holding : device.memory().holdings())
        if (holding.name == "light sent" || holding.name == "links")
            bytes += holding.bytes;
    return bytes;
}

TEST_P(LinksByDevice, LeaveTheDevicesMemoryOnceTheyAreSolved)
{
    const SolveScene world(support::scene_path("cornell-box"), {.size = 32});
    const SolverOptions options = links(0.02);
    const auto& method = std::get<LinksOptions>(options.method);
    LinkRadiosity solver(&device, world, method, options.limits(), Parts::all),
        other(&device, world, method, options.limits(), Parts::all);
    std::uint64_t most = 0;
    int changes = 0;
    EXPECT_TRUE(solve(solver, options, [&](const SolverState&) {
        const std::uint64_t bytes = bytes_of_sweeps(device);
        EXPECT_GE(bytes, most) << "between rounds";
        changes += bytes > most;
        most = bytes;
        return true;
    }));
    EXPECT_GE(changes, 2);
    EXPECT_EQ(bytes_of_sweeps(device), 0u);
    // Steps after a release take it again.
    EXPECT_TRUE(solve(other, options, [&](const SolverState&) {
        other.release();
        return true;
    }));
    EXPECT_EQ(other.irradiance(), solver.irradiance());
}

}  // namespace
}  // namespace lumel
