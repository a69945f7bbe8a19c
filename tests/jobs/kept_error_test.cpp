// What light over kept links states of its error is the real one.

#include <map>

#include "../links/live/open_box.h"
#include "links/live/link_relighter.h"
#include "solved.h"
#include "truth/reference.h"

namespace lumel {
namespace {

using Light = std::vector<glm::vec3>;

constexpr int kSide = 64;  // of the atlas [texels]
constexpr std::uint32_t kSeeds = 4;

struct Case {
    const char* name;
    Scene (*scene)();
    std::uint32_t rays;
    bool filter;
};

Scene cornell_box()
{
    return read_gltf(support::scene_path("cornell-box"));
}

/// Most light comes through a door.
Scene two_rooms()
{
    return read_gltf(support::scene_path("two-rooms"));
}

class StatedOverKeptLinks : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Of, StatedOverKeptLinks,
                         testing::Values(Case{"CornellBox", cornell_box, 64, true},
                                         Case{"CornellBoxByFewRays", cornell_box, 16, true},
                                         Case{"TwoRooms", two_rooms, 64, true},
                                         Case{"TwoRoomsUnfiltered", two_rooms, 64, false},
                                         Case{"BoxUnderTheSky", test::open_box_in_the_sun, 64,
                                              true}),
                         [](const auto& test) { return std::string(test.param.name); });

/// Lumels that are darker than a third of the mean.
std::vector<std::size_t> dark_of(const Light& light)
{
    const auto sum = [](const glm::vec3& one) { return double(one.r + one.g + one.b); };
    double mean = 0.0;
    for (const glm::vec3& one : light)
        mean += sum(one) / double(light.size());
    std::vector<std::size_t> dark;
    for (std::size_t i = 0; i < light.size(); ++i)
        if (3.0 * sum(light[i]) < mean)
            dark.push_back(i);
    return dark;
}

Light chosen(const Light& light, const std::vector<std::size_t>& lumels)
{
    Light some;
    for (const std::size_t i : lumels)
        some.push_back(light[i]);
    return some;
}

void expect_alike(const char* what, double stated, double real)
{
    testing::Test::RecordProperty(what, std::to_string(stated));
    std::printf("%s: stated %.2f %%, real %.2f %%\n", what, 100.0 * stated, 100.0 * real);
    EXPECT_GE(stated / real, 0.75) << what;
    EXPECT_LE(stated / real, 1.5) << what;
}

/// A scene in its atlas, and two independent halves of its reference.
struct Traced {
    explicit Traced(Scene (*scene)()) : world(scene(), AtlasOptions{.size = kSide})
    {
        for (std::uint32_t k = 0; k < 2; ++k)
            truth[k] = reference_irradiance(world.scene, world.rays, world.lumels,
                                            {.samples_per_lumel = 512, .seed = 101 + k});
    }

    SolveScene world;
    Light truth[2];
};

/// Made once for each scene.
const Traced& traced(Scene (*scene)())
{
    static std::map<Scene (*)(), Traced> made;
    return made.try_emplace(scene, scene).first->second;
}

// Both figures, against the reference without its own noise.
TEST_P(StatedOverKeptLinks, IsTheRealError)
{
    const auto& [world, truth] = traced(GetParam().scene);
    const std::vector<std::size_t> dark = dark_of(truth[0]);
    ASSERT_FALSE(dark.empty());
    double stated = 0.0, real = 0.0, dark_stated = 0.0, dark_real = 0.0;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        KeptLightOptions options{
            .rays = GetParam().rays, .seed = seed, .filter = GetParam().filter};
        options.light.seed = seed;
        LinkRelighter light(world, options);
        const Light found = light.irradiance();
        stated += light.error().all / kSeeds;
        real += support::error_alone(found, truth[0], truth[1]) / kSeeds;
        dark_stated += light.error().dark / kSeeds;
        dark_real += support::error_alone(chosen(found, dark), chosen(truth[0], dark),
                                          chosen(truth[1], dark)) /
                     kSeeds;
    }
    expect_alike("all", stated, real);
    expect_alike("dark", dark_stated, dark_real);
}

TEST(ErrorOverKeptLinks, OfNoLightIsNotKnown)
{
    Scene scene = cornell_box();
    for (Material& material : scene.materials)
        material.emitted = glm::vec3(0.0f);
    const SolveScene world(std::move(scene), AtlasOptions{.size = 16});
    LinkRelighter light(world, {.rays = 4});
    light.irradiance();
    EXPECT_LT(light.error().all, 0.0);
    EXPECT_LT(light.error().dark, 0.0);
}

}  // namespace
}  // namespace lumel
