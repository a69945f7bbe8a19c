// Sweeps of a device against those of the host: the same light, bit for bit.

#include "links/sweeps/device_sweeps.h"

#include <bit>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "../../rays/device/rooms.h"
#include "../../support/source_folder.h"
#include "traced_scene.h"

namespace lumel {
namespace {

constexpr double kResidual = 1e-3;

using Light = std::vector<glm::vec3>;

struct SweptLight {
    Light received;
    LinkSolver::Swept swept;

    bool operator==(const SweptLight& other) const
    {
        return received.size() == other.received.size() && swept == other.swept &&
               std::memcmp(received.data(), other.received.data(),
                           received.size() * sizeof(glm::vec3)) == 0;
    }
};

/// Sub-lumels of different light.
std::size_t count_different(const Light& one, const Light& other)
{
    std::size_t count = 0;
    for (std::size_t p = 0; p < one.size(); ++p)
        count += std::memcmp(&one[p], &other[p], sizeof(glm::vec3)) != 0;
    return count;
}

class SweepsOnADevice : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(device.validation_messages(), ""); }

    SweptLight by_host(const support::TracedScene& traced, SweptLight from = {}) const
    {
        from.swept = traced.solver.solve(traced.links, traced.source, kResidual, from.received,
                                         from.swept.factor);
        return from;
    }

    void update(DeviceLinks& copy, const support::TracedScene& traced,
                const DeviceLinkLimits& limits = {}) const
    {
        copy.update(device, {traced.work, traced.parts, traced.numbers}, traced.links, limits);
    }

    SweptLight by_device(const support::TracedScene& traced, DeviceSweeps& sweeps,
                         DeviceLinks& copy, SweptLight from = {}) const
    {
        update(copy, traced);
        from.swept = traced.solver.solve_on(sweeps, copy, traced.links, traced.source, kResidual,
                                            from.received, from.swept.factor);
        return from;
    }

    /// Solves round after round, the later ones from the light of those before.
    void expect_equal_rounds(support::TracedScene& traced) const
    {
        DeviceSweeps sweeps(device, traced.solver.albedo());
        DeviceLinks copy;
        SweptLight host, found;
        const RayGuide guide = traced.striped_guide();
        for (const RayGuide* by : {static_cast<const RayGuide*>(nullptr), &guide, &guide}) {
            traced.trace(12, by);
            host = by_host(traced, host);
            copy = {};  // earlier rays got other weights
            found = by_device(traced, sweeps, copy, found);
            EXPECT_EQ(count_different(found.received, host.received), 0u)
                << "of " << host.received.size() << ", round " << traced.links.rounds.size();
            EXPECT_EQ(found.swept, host.swept);
            EXPECT_GT(found.swept.sweeps, 2);
        }
        DeviceSweeps others(device, traced.solver.albedo());
        DeviceLinks other_copy;
        EXPECT_TRUE(by_device(traced, others, other_copy) == by_device(traced, sweeps, copy));
    }

    gpu::Device device;
};

Scene closed_room(float albedo)
{
    const auto walls =
        support::box_walls({0, 0, 0}, {2.0f, 1.5f, 3.0f}, true,
                           {.albedo = glm::vec3(albedo), .emission = glm::vec3(1.0f)});
    Scene scene = support::make_quads({walls.begin(), walls.end()}).scene;
    scene.max_albedo = 1.0f;
    return scene;
}

TEST_F(SweepsOnADevice, GiveTheHostsLightInTheCornellBox)
{
    support::TracedScene traced(support::source_path("scenes/cornell-box.gltf"),
                                AtlasOptions{.size = 64});
    expect_equal_rounds(traced);
}

// Cut lumels, and rays that are reflected close to theirs.
TEST_F(SweepsOnADevice, GiveTheHostsLightInAFurnishedRoom)
{
    support::TracedScene traced(support::source_path("scenes/room.gltf"), AtlasOptions{.size = 96});
    expect_equal_rounds(traced);
}

TEST_F(SweepsOnADevice, GiveTheHostsLightBehindGlass)
{
    support::TracedScene traced(support::room_with_curtains(), AtlasOptions{.size = 48});
    expect_equal_rounds(traced);
}

TEST_F(SweepsOnADevice, GiveTheHostsLightInAClosedRoom)
{
    support::TracedScene traced(closed_room(0.9f), AtlasOptions{.size = 64});
    expect_equal_rounds(traced);
}

TEST_F(SweepsOnADevice, CorrectLevelsOfBrightRoomsAsTheHostDoes)
{
    support::TracedScene traced(closed_room(0.99f), AtlasOptions{.size = 48});
    traced.trace(12);
    DeviceSweeps sweeps(device, traced.solver.albedo());
    DeviceLinks copy;
    EXPECT_TRUE(by_device(traced, sweeps, copy) == by_host(traced));
    EXPECT_TRUE(sweeps.times().contains("correct levels"));
}

/// Replaces all ends by random ones, with near links and weights of any size.
void randomize(support::TracedScene& traced, float light)
{
    std::mt19937 random(3);
    const auto end = [&] { return LinkEnd::of(std::uint32_t(random() % traced.numbers.count())); };
    for (std::vector<LinkBlock>& round : traced.links.rounds)
        for (LinkBlock& block : round) {
            block.near.clear();
            block.near_light.clear();
            block.weights.resize(block.ends.size());
            for (std::uint32_t slot = 0; slot < block.ends.size(); ++slot) {
                block.ends[slot] = end();
                block.weights[slot] = 0.4f + 0.001f * float(random() % 2000);
                if (random() % 4 != 0)
                    continue;
                block.ends[slot] = LinkEnd::of(LinkNumbers::kNear);
                // Weights below 1 of random exponents.
                const std::uint32_t exponent = std::uint32_t(random() % 16);
                block.near.push_back({slot, end(), exponent << 27 | std::uint32_t(random() >> 5)});
                block.near_light.push_back({});
            }
        }
    std::uniform_real_distribution<float> any(0.0f, 1.0f);
    for (glm::vec4& source : traced.source.light)
        source =
            glm::vec4(without_tiny(light * glm::vec3(any(random), any(random), any(random))), 0.0f);
    for (float& rays : traced.source.rays)
        rays = random() % 50 == 0 ? 0.0f : 40.0f + 8.0f * any(random);
}

TEST_F(SweepsOnADevice, GiveTheHostsLightOfRandomLinks)
{
    support::TracedScene traced(support::source_path("scenes/two-rooms.gltf"),
                                AtlasOptions{.size = 64});
    traced.trace(8);
    traced.trace(16);
    // The last is so dim that devices may drop products of it.
    for (const float light : {1.0f, 1e6f, 1e-20f, 1e-22f, 1e-24f}) {
        randomize(traced, light);
        DeviceSweeps sweeps(device, traced.solver.albedo());
        DeviceLinks copy;
        EXPECT_TRUE(by_device(traced, sweeps, copy) == by_host(traced)) << light;
    }
}

TEST_F(SweepsOnADevice, GiveTheHostsLightOfASceneWithoutLinks)
{
    support::TracedScene traced(support::source_path("scenes/cornell-box.gltf"),
                                AtlasOptions{.size = 16});
    traced.trace(1);
    traced.links.rounds.clear();
    DeviceSweeps sweeps(device, traced.solver.albedo());
    DeviceLinks copy;
    EXPECT_TRUE(by_device(traced, sweeps, copy) == by_host(traced));
}

TEST_F(SweepsOnADevice, GiveTheHostsLightInSmallSlabsAndDispatches)
{
    support::TracedScene traced(closed_room(0.99f), AtlasOptions{.size = 64});
    const RayGuide guide = traced.striped_guide();
    traced.trace(8);
    traced.trace(4, &guide);
    DeviceLinks whole, copy;
    update(whole, traced);
    EXPECT_EQ(whole.slabs().size(), traced.links.rounds.size());
    update(copy, traced, {.slab_bytes = whole.bytes() / 8});
    EXPECT_GT(copy.slabs().size(), 2 * whole.slabs().size());
    EXPECT_EQ(copy.bytes(), whole.bytes());
    // Several dispatches of each kernel, the first of them in two pieces.
    DeviceSweeps sweeps(device, traced.solver.albedo(), {.probe = 2, .most = 5});
    EXPECT_TRUE(by_device(traced, sweeps, copy) == by_host(traced));
    EXPECT_TRUE(sweeps.times().contains("correct levels"));
}

TEST_F(SweepsOnADevice, KeepTheirLinksWhereThereIsNoMemoryForMore)
{
    support::TracedScene traced(support::source_path("scenes/cornell-box.gltf"),
                                AtlasOptions{.size = 32});
    traced.trace(8);
    DeviceLinks copy, other;
    update(copy, traced);
    const std::uint64_t before = copy.bytes();
    traced.trace(12);
    update(other, traced);
    const std::uint64_t added = other.bytes() - before;
    EXPECT_THROW(update(copy, traced, {.bytes = added - 1}), gpu::OutOfMemory);
    EXPECT_EQ(copy.bytes(), before);
    update(copy, traced, {.bytes = added});
    DeviceSweeps sweeps(device, traced.solver.albedo());
    EXPECT_TRUE(by_device(traced, sweeps, copy) == by_host(traced));
}

}  // namespace
}  // namespace lumel
