// Links whose rays a device casts, against those of the host and against a closed form.

#include "../../jobs/solved.h"
#include "rooms.h"
#include "truth/closed_forms.h"

namespace lumel {
namespace {

using LinksByQueries = support::OnDeviceWithRayQueries;

SolverOptions links(Rays rays, double error)
{
    return {.method = LinksOptions{.rays = rays}, .target_error = error};
}

/// Mean of |difference| in terms of the mean.
double apart(const std::vector<glm::vec3>& one, const std::vector<glm::vec3>& other)
{
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            difference += std::abs(double(one[i][c]) - double(other[i][c]));
            sum += double(other[i][c]);
        }
    return difference / sum;
}

void expect_agreement(const Prepared& world)
{
    // As many rays for both: an error to stop at may be reached a round earlier by one of them.
    constexpr std::uint64_t kRays = 48;
    const auto solved = [&](Rays rays) {
        return support::solve_scene(
            world, {.method = LinksOptions{.rays = rays}, .max_shots = kRays, .target_error = 0.0});
    };
    const auto host = solved(Rays::host), query = solved(Rays::query);
    EXPECT_EQ(query.state.shots, host.state.shots);
    const double difference = apart(query.irradiance, host.irradiance);
    std::printf("%.5f %% apart\n", 100.0 * difference);
    EXPECT_LE(difference, 0.005);
    EXPECT_NEAR(query.state.error, host.state.error, 0.02 * host.state.error);
}

TEST_F(LinksByQueries, LightTheCornellBoxAsTheHostDoes)
{
    expect_agreement(Prepared(support::scene_path("cornell-box"), {.size = 64}));
}

TEST_F(LinksByQueries, LightTwoRoomsAsTheHostDoes)
{
    expect_agreement(Prepared(support::scene_path("two-rooms"), {.size = 64}));
}

TEST_F(LinksByQueries, LightAFurnishedRoomAsTheHostDoes)
{
    expect_agreement(Prepared(support::scene_path("room"), {.size = 96}));
}

TEST_F(LinksByQueries, PassGlassCutOutsAndVeilsAsTheHostDoes)
{
    expect_agreement(Prepared(support::room_with_curtains(), {.size = 48}));
}

TEST_F(LinksByQueries, MakeAClosedRoomGlowAsItsAbsorptionAllows)
{
    const double albedo = 0.9;
    support::Quad look{.albedo = glm::vec3(float(albedo)), .emission = glm::vec3(1.0f)};
    look.res_u = look.res_v = 16;
    const auto walls = support::box_walls({0, 0, 0}, {2.0f, 1.5f, 3.0f}, true, look);
    const std::vector<support::Quad> quads(walls.begin(), walls.end());
    support::HandMade room = support::make_quads(quads);
    const Atlas atlas = support::lay_out(room, quads);
    const RayScene rays(room.scene);
    const auto solved =
        support::solve_scene(room.scene, rays, room.lumels, links(Rays::query, 0.02), &atlas);
    const double truth = furnace_irradiance(1.0, albedo);
    double light = 0.0, area = 0.0;
    for (std::size_t i = 0; i < solved.irradiance.size(); ++i) {
        light += double(room.lumels.lumels[i].area) * double(solved.irradiance[i].g);
        area += double(room.lumels.lumels[i].area);
    }
    EXPECT_NEAR(light / area, truth, 0.01 * truth);
}

TEST_F(LinksByQueries, GiveTheSameBytesAgain)
{
    const Prepared world(support::scene_path("cornell-box"), {.size = 32});
    const SolverOptions options = links(Rays::query, 0.05);
    EXPECT_EQ(support::solve_scene(world, options).irradiance,
              support::solve_scene(world, options).irradiance);
}

}  // namespace
}  // namespace lumel
