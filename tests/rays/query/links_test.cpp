// Links whose rays a device casts, against those of the host and against a closed form.

#include "../../jobs/closed_room.h"
#include "../../support/closed_forms.h"
#include "compared_links.h"

namespace lumel {
namespace {

using LinksByQueries = support::OnDeviceWithRayQueries;

SolverOptions links(Rays rays, double error)
{
    return {.method = LinksOptions{.rays = rays}, .target_error = error};
}

class LinksInRoomsByQueries : public LinksByQueries,
                              public testing::WithParamInterface<support::ComparedRoom> {};

INSTANTIATE_TEST_SUITE_P(Of, LinksInRoomsByQueries, testing::ValuesIn(support::kComparedRooms),
                         support::name_of_room);

TEST_P(LinksInRoomsByQueries, LightAsTheHostDoes)
{
    support::expect_agreement(GetParam(), {.rays = Rays::query}, {.rays = Rays::host}, 0.02);
}

TEST_F(LinksByQueries, MakeAClosedRoomGlowAsItsAbsorptionAllows)
{
    constexpr float kAlbedo = 0.9f;
    const double truth = furnace_irradiance(1.0, double(kAlbedo));
    EXPECT_NEAR(support::mean_in_closed_room(kAlbedo, links(Rays::query, 0.02)), truth,
                0.01 * truth);
}

TEST_F(LinksByQueries, GiveTheSameBytesAgain)
{
    const SolveScene world(support::scene_path("cornell-box"), {.size = 32});
    const SolverOptions options = links(Rays::query, 0.05);
    EXPECT_EQ(support::solve_scene(world, options).irradiance,
              support::solve_scene(world, options).irradiance);
}

}  // namespace
}  // namespace lumel
