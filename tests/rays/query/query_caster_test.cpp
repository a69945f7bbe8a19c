// Rays cast by a device against the same rays cast by the host.

#include "rays/device/query_caster.h"

#include <numeric>
#include <random>

#include "../../jobs/solved.h"
#include "../../support/compare_hits.h"
#include "rooms.h"

namespace lumel {
namespace {

using QueryCaster = support::OnDeviceWithRayQueries;

constexpr std::size_t kRays = 20'000;
/// Rays that run into an edge of two triangles may meet either.
constexpr double kOnEdges = 1e-3;

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

void expect_agreement(const gpu::Device& device, const Scene& scene)
{
    const RayScene rays(scene);
    const auto host = cast_on_host(rays), query = cast_by_queries(device, rays);
    std::vector<RaySpan> between = random_rays(rays), out = between;
    for (RaySpan& ray : out)
        ray.far = std::numeric_limits<float>::max();
    std::vector<RayHit> by_host(kRays), by_query(kRays);
    host->closest(out, by_host);
    query->closest(out, by_query);
    std::vector<glm::vec3> transmittance_host(kRays), transmittance_query(kRays);
    host->transmittance(between, transmittance_host);
    query->transmittance(between, transmittance_query);
    std::size_t other_hits = 0, other_transmittance = 0, clear = 0;
    for (std::size_t i = 0; i < kRays; ++i) {
        other_hits += !support::same(by_host[i], by_query[i]);
        other_transmittance +=
            !(glm::distance(transmittance_host[i], transmittance_query[i]) < support::kHitRounding);
        clear += transmittance_host[i] != glm::vec3(0.0f);
    }
    EXPECT_LE(double(other_hits), kOnEdges * kRays);
    EXPECT_LE(double(other_transmittance), kOnEdges * kRays);
    EXPECT_GT(clear, kRays / 100);
    EXPECT_LT(clear, kRays);
}

TEST_F(QueryCaster, MeetsInTheCornellBoxWhatTheHostMeets)
{
    const SolveScene world(support::scene_path("cornell-box"), {.size = 16});
    expect_agreement(device, world.scene);
}

TEST_F(QueryCaster, MeetsInTwoRoomsWhatTheHostMeets)
{
    const SolveScene world(support::scene_path("two-rooms"), {.size = 16});
    expect_agreement(device, world.scene);
}

TEST_F(QueryCaster, LetsPassWhatTheHostLetsPass)
{
    expect_agreement(device, support::room_with_curtains());
}

TEST_F(QueryCaster, MeetsNothingWhereThereIsNothing)
{
    const Scene scene;
    const RayScene rays(scene);
    const auto query = cast_by_queries(device, rays);
    const RaySpan ray = ray_out({0, 0, 0}, {0, 0, 1}, 0);
    RayHit hit;
    glm::vec3 transmittance(0.0f);
    query->closest({&ray, 1}, {&hit, 1});
    query->transmittance({&ray, 1}, {&transmittance, 1});
    EXPECT_EQ(hit.distance, RayCaster::kNothing);
    EXPECT_EQ(transmittance, glm::vec3(1.0f));
}

TEST_F(QueryCaster, CastsMoreRaysThanFitIntoItsArrays)
{
    Scene scene;
    support::add_quad(scene, {});
    const RayScene rays(scene);
    const auto query = cast_by_queries(device, rays);
    const std::size_t count = 10 * query->batch() + 1;
    std::vector<RaySpan> many(count);
    for (std::size_t i = 0; i < count; ++i)
        many[i] = ray_out({i % 2 == 0 ? 0.5f : 1.5f, 0.25f, 1.0f}, {0, 0, -1}, 0);
    std::vector<RayHit> hits(count);
    query->closest(many, hits);
    for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(hits[i].distance, i % 2 == 0 ? 1.0f : RayCaster::kNothing) << i;
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
        EXPECT_NE(std::string(error.what()).find("use --rays host"), std::string::npos);
    }
}

}  // namespace
}  // namespace lumel
