// Links whose rays are cast by drawing, against those of the host.

#include "../device/compared_links.h"

namespace lumel {
namespace {

double power(const Lumels& lumels, const std::vector<glm::vec3>& light)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i)
        sum += double(lumels.lumels[i].area) * double(light[i].r + light[i].g + light[i].b);
    return sum;
}

/// Directions that lumels share bring the light that directions of their own bring. By the host,
/// for so many rays that noise does not hide a difference.
void expect_the_same_level(const SolveScene& world)
{
    constexpr std::uint64_t kRays = 1536;
    const support::Solved own = support::solve_links(world, {.rays = Rays::host}, kRays);
    const support::Solved shared =
        support::solve_links(world, {.rays = Rays::host, .shared_directions = true}, kRays);
    const double more =
        power(world.lumels, shared.irradiance) / power(world.lumels, own.irradiance) - 1.0;
    std::printf("%.3f %% more light, %.2f and %.2f %% stated\n", 100.0 * more,
                100.0 * shared.state.error, 100.0 * own.state.error);
    EXPECT_NEAR(more, 0.0, 0.005);
    EXPECT_NEAR(shared.state.error, own.state.error, 0.5 * own.state.error);
}

class LinksInRoomsByRaster : public testing::TestWithParam<support::ComparedRoom> {};

INSTANTIATE_TEST_SUITE_P(Of, LinksInRoomsByRaster, testing::ValuesIn(support::kComparedRooms),
                         support::name_of_room);

// A few lumels hold much of an error: one ray that rounding sends elsewhere tells.
TEST_P(LinksInRoomsByRaster, LightAsTheHostDoes)
{
    support::expect_agreement(GetParam(), {.rays = Rays::raster},
                              {.rays = Rays::host, .shared_directions = true}, 0.05);
}

TEST(LinksByRaster, LeaveASealedBoxExactlyDarkUnderSkyAndSun)
{
    LightOptions lights{.sky_color = glm::vec3(1e4f)};
    set_sun(lights, "200,40");
    const Scene scene =
        read_scene(support::scene_path("sealed-box"), MaterialModel::diffuse, lights);
    const SolveScene world(scene, AtlasOptions{.size = 64});
    const std::vector<glm::vec3> light =
        support::solve_links(world, {.rays = Rays::raster}, 96).irradiance;
    float brightest = 0.0f;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        brightest = std::max(brightest, light[i].g);
        if (scene.instances[world.lumels.lumels[i].instance].name != "box inside")
            continue;
        ++inside;
        EXPECT_EQ(light[i], glm::vec3(0.0f)) << "lumel " << i;
    }
    EXPECT_GT(inside, 50u);
    EXPECT_GT(brightest, 1e4f);
}

TEST(SharedDirections, LightTheCornellBoxAsOwnOnesDo)
{
    expect_the_same_level(SolveScene(support::scene_path("cornell-box"), {.size = 64}));
}

TEST(SharedDirections, PassGlassCutOutsAndVeilsAsOwnOnesDo)
{
    expect_the_same_level(SolveScene(support::room_with_curtains(), {.size = 48}));
}

/// A small set of directions would leave its pattern in the light, which the filter takes for true.
TEST(SharedDirections, LeaveNoPattern)
{
    const SolveScene world(support::scene_path("cornell-box"), {.size = 128});
    // Two of them, so that their own noise does not count.
    const auto truth = [&](std::uint32_t seed) {
        return support::solve_links(world, {.seed = seed, .rays = Rays::host}, 384).irradiance;
    };
    const std::vector<glm::vec3> first = truth(101), second = truth(102);
    const auto error = [&](bool is_shared) {
        double square = 0.0;
        constexpr std::uint32_t kSeeds = 4;
        for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
            const LinksOptions method{
                .seed = seed, .guide = false, .rays = Rays::host, .shared_directions = is_shared};
            const double one = support::error_alone(
                support::solve_links(world, method, 96).irradiance, first, second);
            square += one * one / kSeeds;
        }
        return std::sqrt(square);
    };
    const double own = error(false), shared = error(true);
    std::printf("own %.3f %%, shared %.3f %%\n", 100.0 * own, 100.0 * shared);
    EXPECT_LE(shared, 1.1 * own);
}

TEST(LinksByRaster, GiveTheSameBytesAgain)
{
    const SolveScene world(support::scene_path("cornell-box"), {.size = 32});
    EXPECT_EQ(support::solve_links(world, {.rays = Rays::raster}, 48).irradiance,
              support::solve_links(world, {.rays = Rays::raster}, 48).irradiance);
}

}  // namespace
}  // namespace lumel
