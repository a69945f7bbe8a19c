// Rays cast by a device against the same rays cast by the host.

#include "rays/device/device_caster.h"

#include <numeric>
#include <random>

#include "../../jobs/solved.h"
#include "../../support/compare_hits.h"
#include "links/trace/link_casters.h"
#include "rooms.h"

namespace lumel {
namespace {

class DeviceCaster : public support::ByDeviceRays {
protected:
    void expect_agreement(const Scene& scene) const;
};

INSTANTIATE_TEST_SUITE_P(Of, DeviceCaster, testing::ValuesIn(support::kDeviceRays),
                         support::name_of_rays);

constexpr std::size_t kRays = 1'000'000;
/// Rays that run into an edge of two triangles may meet either.
constexpr double kOnEdges = 1e-5;

/// Rays between random points of the scene's bounding box.
std::vector<RaySpan> random_rays(const RayScene& rays)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(0.02f, 0.98f);
    const auto point = [&] {
        const glm::vec3 at(share(random), share(random), share(random));
        return rays.low() + at * (rays.high() - rays.low());
    };
    std::vector<RaySpan> result(kRays);
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const glm::vec3 from = point();
        result[i] = ray_between(from, point(), rays.ray_offset(), i);
    }
    return result;
}

/// Of surfaces that touch, either may be met.
bool end_alike(const RayHit& one, const RayHit& other)
{
    const bool together = one.distance == other.distance ||
                          std::abs(one.distance - other.distance) < support::kHitRounding;
    return together && one.tint == other.tint;
}

void DeviceCaster::expect_agreement(const Scene& scene) const
{
    const RayScene rays(scene);
    const auto host = cast_on_host(rays), on_device = GetParam().cast(device, rays);
    std::vector<RaySpan> between = random_rays(rays), out = between;
    for (RaySpan& ray : out)
        ray.far = std::numeric_limits<float>::max();
    std::vector<RayHit> by_host(kRays), by_device(kRays);
    host->closest(out, by_host);
    on_device->closest(out, by_device);
    std::vector<glm::vec3> transmittance_host(kRays), transmittance_device(kRays);
    host->transmittance(between, transmittance_host);
    on_device->transmittance(between, transmittance_device);
    std::size_t other_hits = 0, other_transmittance = 0, clear = 0;
    for (std::size_t i = 0; i < kRays; ++i) {
        other_hits += !end_alike(by_host[i], by_device[i]);
        other_transmittance += !(glm::distance(transmittance_host[i], transmittance_device[i]) <
                                 support::kHitRounding);
        clear += transmittance_host[i] != glm::vec3(0.0f);
    }
    EXPECT_LE(double(other_hits), kOnEdges * kRays);
    EXPECT_LE(double(other_transmittance), kOnEdges * kRays);
    EXPECT_GT(clear, kRays / 100);
    EXPECT_LT(clear, kRays);
}

TEST_P(DeviceCaster, MeetsInTheCornellBoxWhatTheHostMeets)
{
    expect_agreement(read_gltf(support::scene_path("cornell-box")));
}

TEST_P(DeviceCaster, MeetsInTwoRoomsWhatTheHostMeets)
{
    expect_agreement(read_gltf(support::scene_path("two-rooms")));
}

TEST_P(DeviceCaster, MeetsInAFurnishedRoomWhatTheHostMeets)
{
    expect_agreement(read_gltf(support::scene_path("room")));
}

TEST_P(DeviceCaster, MeetsInACityWhatTheHostMeets)
{
    expect_agreement(read_gltf(support::scene_path("city")));
}

TEST_P(DeviceCaster, LetsPassWhatTheHostLetsPass)
{
    expect_agreement(support::room_with_curtains());
}

// Rays onto the corners, edges and diagonals of a plate of many quads.
TEST_P(DeviceCaster, LetsNoRayBetweenTriangles)
{
    if (GetParam().option == Rays::query)
        GTEST_SKIP() << "Vulkan does not promise that ray queries are watertight; Mesa's are not";
    constexpr int kSide = 24;
    constexpr float kStep = 0.375f;  // neighbours have the same corners to the bit
    Scene scene;
    std::vector<RaySpan> rays;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const glm::vec3 corner(kStep * float(x), kStep * float(y), 0.0f);
            support::add_quad(
                scene,
                {.corner = corner, .edge_u = {kStep, 0.0f, 0.0f}, .edge_v = {0.0f, kStep, 0.0f}});
            if (x == 0 || y == 0)
                continue;
            for (const glm::vec2& at :
                 {glm::vec2(0.0f), {0.5f, 0.0f}, {0.0f, 0.5f}, {0.5f, 0.5f}}) {
                const glm::vec3 on = corner + kStep * glm::vec3(at, 0.0f);
                rays.push_back(ray_out(on + glm::vec3(0, 0, 2), {0, 0, -1}, 0));
                const glm::vec3 from(3.1f, 2.7f, 1.9f);
                rays.push_back(ray_out(from, glm::normalize(on - from), 0));
            }
        }
    const RayScene traced(scene);
    std::vector<RayHit> hits(rays.size());
    GetParam().cast(device, traced)->closest(rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i)
        EXPECT_NEAR(rays[i].origin.z + hits[i].distance * rays[i].direction.z, 0.0f, 1e-5f) << i;
}

TEST_P(DeviceCaster, MeetsNothingWhereThereIsNothing)
{
    const Scene scene;
    const RayScene rays(scene);
    const auto caster = GetParam().cast(device, rays);
    const RaySpan ray = ray_out({0, 0, 0}, {0, 0, 1}, 0);
    RayHit hit;
    glm::vec3 transmittance(0.0f);
    caster->closest({&ray, 1}, {&hit, 1});
    caster->transmittance({&ray, 1}, {&transmittance, 1});
    EXPECT_EQ(hit.distance, RayCaster::kNothing);
    EXPECT_EQ(transmittance, glm::vec3(1.0f));
}

TEST_P(DeviceCaster, CastsMoreRaysThanFitIntoItsArrays)
{
    Scene scene;
    support::add_quad(scene, {});
    const RayScene rays(scene);
    const auto caster = GetParam().cast(device, rays);
    const std::size_t count = 10 * caster->batch() + 1;
    std::vector<RaySpan> many(count);
    for (std::size_t i = 0; i < count; ++i)
        many[i] = ray_out({i % 2 == 0 ? 0.5f : 1.5f, 0.25f, 1.0f}, {0, 0, -1}, 0);
    std::vector<RayHit> hits(count);
    caster->closest(many, hits);
    for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(hits[i].distance, i % 2 == 0 ? 1.0f : RayCaster::kNothing) << i;
}

TEST(AutomaticRays, AreQueriesOfAGpuThatHasThemElseTheHosts)
{
    EXPECT_EQ(automatic_rays({.type = "discrete", .ray_queries = true}), Rays::query);
    EXPECT_EQ(automatic_rays({.type = "discrete"}), Rays::host);
    EXPECT_EQ(automatic_rays({.type = "cpu", .ray_queries = true}), Rays::host);
    EXPECT_EQ(automatic_rays({}), Rays::host);
}

TEST(RaysOfADeviceWithoutQueries, AreRefusedWithARemedy)
{
    const gpu::Device device;
    if (device.can_query_rays())
        GTEST_SKIP() << device.info().name << " has ray queries";
    const Scene scene;
    const RayScene rays(scene);
    try {
        cast_by_queries(device, rays);
        FAIL() << "they were cast";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("use --rays tree"), std::string::npos);
    }
}

}  // namespace
}  // namespace lumel
