// Rays cast by drawing against the same rays cast by the host.

#include "rays/device/bundle_caster.h"

#include <random>

#include "../../jobs/solved.h"
#include "../../support/compare_hits.h"
#include "../device/rooms.h"

namespace lumel {
namespace {

/// Rays that run into an edge of two triangles may meet either.
constexpr double kOnEdges = 1e-3;

/// Rays of a test with the indices of their directions.
struct Bundles {
    std::vector<glm::vec3> directions;
    std::vector<std::uint32_t> along;
    std::vector<RaySpan> rays;

    void add(const glm::vec3& from, std::uint32_t direction)
    {
        along.push_back(direction);
        rays.push_back(ray_out(from, directions[direction], std::uint32_t(rays.size())));
    }
};

std::vector<glm::vec3> random_directions(std::size_t count)
{
    std::mt19937 random(11);
    std::normal_distribution<float> part;
    std::vector<glm::vec3> result(count);
    for (glm::vec3& one : result)
        one = glm::normalize(glm::vec3(part(random), part(random), part(random)));
    return result;
}

/// From random points of the scene's bounding box.
Bundles random_bundles(const RayScene& scene, std::size_t directions, std::size_t rays)
{
    Bundles bundles{.directions = random_directions(directions), .along = {}, .rays = {}};
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    for (std::size_t i = 0; i < rays; ++i) {
        const glm::vec3 at(share(random), share(random), share(random));
        bundles.add(scene.low() + at * (scene.high() - scene.low()),
                    std::uint32_t(random() % directions));
    }
    return bundles;
}

class BundleCasterTest : public testing::Test {
protected:
    void SetUp() override
    {
        if (!device.can_list_fragments())
            GTEST_SKIP() << device.info().name << " cannot write lists while it draws";
    }
    void TearDown() override { EXPECT_EQ(device.validation_messages(), ""); }

    std::vector<RayHit> cast(const RayScene& scene, const Bundles& bundles) const
    {
        std::vector<RayHit> hits(bundles.rays.size());
        BundleCaster(device, scene)
            .closest({bundles.directions, bundles.along, bundles.rays}, hits);
        return hits;
    }
    void expect_agreement(const Scene& scene) const
    {
        const RayScene rays(scene);
        const Bundles bundles = random_bundles(rays, 100, 20'000);
        const std::vector<RayHit> hits = cast(rays, bundles);
        std::vector<RayHit> on_host(hits.size());
        cast_on_host(rays)->closest(bundles.rays, on_host);
        std::size_t other = 0, met = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            other += !support::same(hits[i], on_host[i]);
            met += hits[i].distance != RayCaster::kNothing;
        }
        EXPECT_LE(double(other), kOnEdges * double(hits.size()));
        EXPECT_GT(met, hits.size() / 10);
    }

    gpu::Device device;
};

TEST_F(BundleCasterTest, MeetsInTheCornellBoxWhatTheHostMeets)
{
    const SolveScene world(support::scene_path("cornell-box"), {.size = 16});
    expect_agreement(world.scene);
}

TEST_F(BundleCasterTest, MeetsInTwoRoomsWhatTheHostMeets)
{
    const SolveScene world(support::scene_path("two-rooms"), {.size = 16});
    expect_agreement(world.scene);
}

TEST_F(BundleCasterTest, MeetsInAFurnishedRoomWhatTheHostMeets)
{
    const SolveScene world(support::scene_path("room"), {.size = 96});
    expect_agreement(world.scene);
}

TEST_F(BundleCasterTest, LetsPassWhatTheHostLetsPass)
{
    expect_agreement(support::room_with_curtains());
}

/// A wall of a closed box as a grid of triangles whose corners are shared, from corner to corner.
void add_wall(Scene& scene, const support::Quad& wall)
{
    constexpr std::uint32_t kSide = 12;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t v = 0; v <= kSide; ++v)
        for (std::uint32_t u = 0; u <= kSide; ++u)
            positions.push_back(wall.corner + float(u) / float(kSide) * wall.edge_u +
                                float(v) / float(kSide) * wall.edge_v);
    for (std::uint32_t v = 0; v < kSide; ++v)
        for (std::uint32_t u = 0; u < kSide; ++u) {
            const std::uint32_t a = v * (kSide + 1) + u, d = a + kSide + 1;
            indices.insert(indices.end(), {a, a + 1, d + 1, a, d + 1, d});
        }
    support::add_mesh(scene, positions, indices, {});
}

/// No ray slips between two triangles, where they meet in a wall or where walls meet.
TEST_F(BundleCasterTest, LetsNoRayOutOfAClosedBox)
{
    Scene scene;
    for (const support::Quad& wall : support::box_walls({0, 0, 0}, {2.0f, 1.5f, 3.0f}, true, {}))
        add_wall(scene, wall);
    const RayScene rays(scene);
    // Straight into edges and corners, too.
    Bundles bundles = random_bundles(rays, 100, 100'000);
    for (const glm::vec3& corner : {glm::vec3(0), glm::vec3(2.0f, 1.5f, 3.0f), glm::vec3(2, 0, 0)})
        for (int k = 1; k < 500; ++k) {
            const auto at = float(k) / 500.0f;
            const glm::vec3 from(0.1f + 1.8f * at, 0.7f, 0.4f + 2.0f * at * at);
            bundles.directions.push_back(glm::normalize(corner - from));
            bundles.add(from, std::uint32_t(bundles.directions.size()) - 1);
        }
    const std::vector<RayHit> hits = cast(rays, bundles);
    std::size_t out = 0;
    for (std::size_t i = 0; i < hits.size(); ++i)
        out += hits[i].distance == RayCaster::kNothing;
    EXPECT_EQ(out, 0u);
}

TEST_F(BundleCasterTest, MeetsNothingWhereThereIsNothing)
{
    const Scene scene;
    const RayScene rays(scene);
    Bundles bundles{.directions = {{0, 0, 1}}, .along = {}, .rays = {}};
    bundles.add({0, 0, 0}, 0);
    EXPECT_EQ(cast(rays, bundles)[0].distance, RayCaster::kNothing);
}

/// Sheets behind one another fill more lists than the device holds at once.
TEST_F(BundleCasterTest, ListsMoreThanFitsIntoItsArrays)
{
    constexpr std::uint32_t kSheets = 1500;
    Scene scene;
    for (std::uint32_t k = 0; k < kSheets; ++k)
        support::add_quad(scene, {.corner = {0, 0, 1e-3f * float(k)}});
    const RayScene rays(scene);
    Bundles bundles{.directions = {{0, 0, 1}, {0, 0, -1}}, .along = {}, .rays = {}};
    for (std::uint32_t k = 0; k + 1 < kSheets; ++k)
        for (const std::uint32_t direction : {0u, 1u})
            bundles.add({0.25f, 0.7f, 1e-3f * (float(k) + 0.5f)}, direction);
    const std::vector<RayHit> hits = cast(rays, bundles);
    for (std::uint32_t i = 0; i < hits.size(); ++i)
        ASSERT_EQ(hits[i].instance, i / 2 + (bundles.along[i] == 0 ? 1 : 0)) << i;
}

TEST_F(BundleCasterTest, CastsMoreRaysAndDirectionsThanFitIntoItsArrays)
{
    constexpr std::uint32_t kDirections = 3000, kRays = 600'000;
    Scene scene;
    support::add_quad(scene, {});
    const RayScene rays(scene);
    Bundles bundles{.directions = random_directions(kDirections), .along = {}, .rays = {}};
    // All rays of the first direction, so many, and some of each other.
    const glm::vec3 middle(0.5f, 0.5f, 0.0f);
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const std::uint32_t direction = i % 2 == 0 ? 0 : i / 2 % kDirections;
        const float side = i % 3 == 0 ? 1.0f : -1.0f;
        bundles.add(middle - side * bundles.directions[direction], direction);
    }
    const std::vector<RayHit> hits = cast(rays, bundles);
    for (std::uint32_t i = 0; i < kRays; ++i) {
        if (i % 3 == 0)
            ASSERT_NEAR(hits[i].distance, 1.0f, support::kHitRounding) << i;
        else
            ASSERT_EQ(hits[i].distance, RayCaster::kNothing) << i;
    }
}

}  // namespace
}  // namespace lumel
