// Light on both sides of surfaces without thickness, and where the map has it.

#include <algorithm>
#include <vector>

#include "../support/temporary_folder.h"
#include "atlas/finish/finish.h"
#include "atlas/lumels/sides.h"
#include "base/images/image_files.h"
#include "jobs/edit/solution_file.h"
#include "paper_house.h"
#include "results/record/bake_record.h"
#include "solved.h"

namespace lumel {
namespace {

using namespace test;

constexpr float kSun = 1000.0f;     // [lx]
constexpr double kSunHeight = 0.8;  // sine of its elevation

Scene house_with(bool double_sided, bool bulb, bool sun)
{
    Scene scene = paper_house(double_sided);
    if (bulb)
        add_bulb(scene);
    if (sun)
        scene.lights.push_back(support::make_lamp(PunctualLight::Kind::directional, kSun, {0, 0, 0},
                                                  {0.6f, -float(kSunHeight), 0.0f}));
    return scene;
}

constexpr std::uint32_t kCeiling = 3, kFirstOfBlock = 6;  // instances

const SolverOptions kLinks{.method = LinksOptions{}, .target_error = 0.01};

double mean(const SolveScene& world, const std::vector<glm::vec3>& light, std::uint32_t instance,
            bool back)
{
    double sum = 0.0, area = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const Lumel& lumel = world.lumels.lumels[i];
        if (lumel.instance != instance || is_back(lumel) != back)
            continue;
        sum += double(light[i].g) * double(lumel.area);
        area += double(lumel.area);
    }
    return sum / area;
}

TEST(Sides, ShowIndoorLightIndoorsAndDaylightOutdoors)
{
    const SolveScene house(house_with(true, true, true), AtlasOptions{.size = 96});
    const SolveScene room(house_with(false, true, false), AtlasOptions{.size = 96});
    const std::vector<glm::vec3> light = support::solve_scene(house, kLinks).irradiance,
                                 indoors = support::solve_scene(room, kLinks).irradiance;
    const Image map = finish_map(house.scene, house.atlas, house.lumels, light);
    // As lumels have it: what is seen from inside is as if there was no sun, and the roof has the
    // sun alone.
    const double ceiling = mean(room, indoors, kCeiling, false);
    EXPECT_NEAR(mean(house, light, kCeiling, false), ceiling, 0.02 * ceiling);
    EXPECT_NEAR(mean(house, light, kCeiling, true), kSun * kSunHeight, 1e-3 * kSun);
    // As the map has it, each side at its own place.
    for (std::size_t i = 0; i < light.size(); ++i) {
        const Lumel& lumel = house.lumels.lumels[i];
        if (lumel.instance != kCeiling)
            continue;
        const std::uint32_t texel = map_texel(house.lumels, lumel);
        const double shown = double(map.values[4 * std::size_t(texel) + 1]);
        if (is_back(lumel)) {
            EXPECT_NEAR(shown, kSun * kSunHeight, 1e-2 * kSun) << texel;
        } else {
            EXPECT_LT(shown, 0.5 * kSun * kSunHeight) << texel;
        }
        EXPECT_GT(map.values[4 * std::size_t(texel) + 3], 0.0f);
    }
}

std::vector<char> charts_with_own_back(const SolveScene& world, std::uint32_t first_instance,
                                       std::uint32_t end_instance)
{
    std::vector<char> own;
    for (const Surface& surface : world.atlas.surfaces)
        if (surface.instance >= first_instance && surface.instance < end_instance)
            own.push_back(has_own_back(world.atlas, surface));
    return own;
}

/// The same under a sky, which all walls see from outside.
Scene house_under_sky()
{
    Scene scene = house_with(true, true, true);
    scene.sky = support::even_sky(glm::vec3(100.0f));
    return scene;
}

TEST(Sides, HaveTexelsOfTheirOwnWhereLightReachesBoth)
{
    const std::vector<char> all(6, 1), none(6, 0), roof_and_sunny_wall = {1, 0, 0, 1, 0, 0};
    const SolveScene house(house_under_sky(), AtlasOptions{.size = 96});
    EXPECT_EQ(charts_with_own_back(house, 0, kFirstOfBlock), all);
    EXPECT_EQ(charts_with_own_back(house, kFirstOfBlock, 12), none) << "a closed solid";
    const SolveScene sunny(house_with(true, true, true), AtlasOptions{.size = 96});
    EXPECT_EQ(charts_with_own_back(sunny, 0, kFirstOfBlock), roof_and_sunny_wall);
    const SolveScene dark(house_with(true, false, true), AtlasOptions{.size = 96});
    EXPECT_EQ(charts_with_own_back(dark, 0, kFirstOfBlock), none) << "no light inside";
    const SolveScene void_outside(house_with(true, true, false), AtlasOptions{.size = 96});
    EXPECT_EQ(charts_with_own_back(void_outside, 0, kFirstOfBlock), none) << "none outside";
}

/// A sheet separates a room with a bulb from a dark one.
TEST(Sides, OfADarkRoomDoNotShowTheLightBehindItsWalls)
{
    Scene scene = house_with(true, true, false);
    const auto walls = support::box_walls({4, 0, 0}, {8, 3, 4}, true, {.double_sided = true});
    for (std::size_t side = 1; side < walls.size(); ++side)
        support::add_quad(scene, walls[side]);
    const SolveScene house(scene, AtlasOptions{.size = 96});
    const std::vector<char> wall_between = {0, 1, 0, 0, 0, 0};
    EXPECT_EQ(charts_with_own_back(house, 0, kFirstOfBlock), wall_between);
}

/// Its inside is as dark and as wide as a room.
TEST(Sides, OfALargeClosedSolidAreShared)
{
    Scene scene;
    for (const support::Quad& wall : support::box_walls({0, 0, 0}, {10, 8, 10}, true, {}))
        support::add_quad(scene, wall);
    add_bulb(scene);
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (const support::Quad& face : support::box_walls({4, 0, 4}, {7, 3, 7}, false, {})) {
        const auto first = std::uint32_t(positions.size());
        for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u})
            indices.push_back(first + k);
        for (const glm::vec3& aside :
             {glm::vec3(0.0f), face.edge_u, face.edge_u + face.edge_v, face.edge_v})
            positions.push_back(face.corner + aside);
    }
    Material material;
    material.double_sided = true;
    support::add_mesh(scene, positions, indices, material);
    const SolveScene world(std::move(scene), AtlasOptions{.size = 96});
    EXPECT_EQ(charts_with_own_back(world, kFirstOfBlock, kFirstOfBlock + 1),
              std::vector<char>(1, 0));
}

TEST(Sides, AreLitByOneLampAmongMany)
{
    Scene street = house_with(true, true, false);
    for (int i = 0; i < 5000; ++i)
        street.lights.push_back(
            support::make_lamp(PunctualLight::Kind::point, kBulb,
                               {8.0f + float(i % 71), 2.0f, 8.0f + float(i / 71)}, {0, -1, 0}));
    const SolveScene house(street, AtlasOptions{.size = 96});
    const std::vector<char> lit_outside = {0, 1, 0, 0, 0, 1};  // that face the street
    EXPECT_EQ(charts_with_own_back(house, 0, kFirstOfBlock), lit_outside);
}

TEST(Sides, AreLitByASmallEmissiveBulb)
{
    Scene scene = house_with(true, false, true);
    support::add_quad(scene, {.corner = {2.0f, 1.5f, 2.0f},
                              .edge_u = {0.02f, 0.0f, 0.0f},
                              .edge_v = {0.0f, 0.0f, 0.02f},
                              .emission = glm::vec3(1e5f),
                              .double_sided = true});
    const std::vector<char> roof_and_sunny_wall = {1, 0, 0, 1, 0, 0};
    const SolveScene house(scene, AtlasOptions{.size = 96});
    EXPECT_EQ(charts_with_own_back(house, 0, kFirstOfBlock), roof_and_sunny_wall);
}

struct Slab {
    glm::vec3 low, high;  ///< [m]

    /// Distance from its surface [m], negative inside.
    float distance(const glm::vec3& point) const
    {
        const glm::vec3 outside = glm::max(low - point, point - high);
        return std::max({outside.x, outside.y, outside.z});
    }
};

/// Floor, ceiling and walls of a room, which run into each other, as modellers leave them.
std::vector<Slab> slabs_of_room()
{
    constexpr float kThick = 0.3f, kOver[] = {0.0f, 0.17f, 0.11f};  // [m]
    const glm::vec3 room(4.0f, 3.0f, 5.0f);
    std::vector<Slab> slabs;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool above : {false, true}) {
            Slab slab{glm::vec3(-kThick), room + kThick};
            (above ? slab.low : slab.high)[axis] = above ? room[axis] : 0.0f;
            for (int next = 1; next < 3; ++next) {
                slab.low[(axis + next) % 3] -= kOver[next];
                slab.high[(axis + next) % 3] += kOver[next];
            }
            slabs.push_back(slab);
        }
    return slabs;
}

/// 6 instances per slab, and a bulb inside.
Scene room_of_slabs(bool double_sided, float bulb)
{
    Scene scene;
    for (const Slab& slab : slabs_of_room())
        for (const support::Quad& wall : support::box_walls(slab.low, slab.high, false))
            support::add_quad(scene, {.corner = wall.corner,
                                      .edge_u = wall.edge_u,
                                      .edge_v = wall.edge_v,
                                      .double_sided = double_sided});
    scene.lights.push_back(
        support::make_lamp(PunctualLight::Kind::point, bulb, {2.0f, 2.0f, 2.0f}, {0, -1, 0}));
    return scene;
}

/// Distances of a lumel from the surfaces of the other slabs [m], negative inside; ascending.
std::vector<float> from_other_slabs(const Lumel& lumel)
{
    const std::vector<Slab> slabs = slabs_of_room();
    std::vector<float> distances;
    for (std::size_t s = 0; s < slabs.size(); ++s)
        if (lumel.instance / 6 != s)
            distances.push_back(slabs[s].distance(lumel.position));
    std::ranges::sort(distances);
    return distances;
}

void expect_hidden_inside_slabs(const SolveScene& room)
{
    std::size_t hidden = 0, open = 0;
    for (std::size_t i = 0; i < room.open.size(); ++i) {
        const Lumel& lumel = room.lumels.lumels[i];
        const std::vector<float> distances = from_other_slabs(lumel);
        const bool inside =
            is_back(lumel) || (distances[0] < -lumel.size && distances[1] > 4.0f * lumel.size);
        if (!inside && distances[0] < lumel.size)
            continue;  // on the surface of a slab, or near where three meet
        EXPECT_EQ(room.open[i], inside ? 0.0f : 1.0f) << i;
        ++(inside ? hidden : open);
    }
    EXPECT_GT(hidden, 100u);
    EXPECT_GT(open, 1000u);
}

TEST(Sides, InsideSolidsHideWhatIsThereAsBacksDo)
{
    const AtlasOptions options{.size = 192};
    expect_hidden_inside_slabs(SolveScene(room_of_slabs(false, kBulb), options));
    expect_hidden_inside_slabs(SolveScene(room_of_slabs(true, kBulb), options));
    expect_hidden_inside_slabs(SolveScene(room_of_slabs(true, 0.0f), options));  // switched off
}

// One mesh with a layout of its own, whose primitives differ.
TEST(Sides, OfASingleSidedPartHaveNoBack)
{
    Scene scene = house_with(true, true, true);
    Mesh& mesh = scene.meshes[kCeiling];
    Primitive other = mesh.primitives.front();
    for (glm::vec3& position : other.positions)
        position.y += 1.0f;
    other.material = int(scene.materials.size());
    scene.materials.emplace_back();
    mesh.primitives.front().texcoords[1] = {{0, 0}, {0.4f, 0}, {0.4f, 1}, {0, 1}};
    other.texcoords[1] = {{0.6f, 0}, {1, 0}, {1, 1}, {0.6f, 1}};
    mesh.primitives.push_back(other);
    scene.sky = support::even_sky(glm::vec3(100.0f));
    const SolveScene house(scene, AtlasOptions{.size = 96});
    std::vector<char> own;
    for (const Surface& surface : house.atlas.surfaces)
        if (surface.instance == kCeiling) {
            EXPECT_TRUE(surface.authored);
            own.push_back(has_own_back(house.atlas, surface));
        }
    EXPECT_EQ(own, (std::vector<char>{1, 0}));
}

TEST(Sides, AreAsAskedFor)
{
    const auto own = [](Sides sides) {
        const SolveScene house(house_with(true, true, true),
                               AtlasOptions{.size = 96, .sides = sides});
        return charts_with_own_back(house, 0, 12);
    };
    EXPECT_EQ(own(Sides::both), std::vector<char>(12, 1));
    EXPECT_EQ(own(Sides::brighter), std::vector<char>(12, 0));
    EXPECT_EQ(own(Sides::front), std::vector<char>(12, 0));
}

TEST(Sides, OfTheFrontAloneShowTheFront)
{
    const SolveScene house(house_with(true, true, true),
                           AtlasOptions{.size = 64, .sides = Sides::front});
    std::vector<glm::vec3> light;
    for (const Lumel& lumel : house.lumels.lumels)
        light.emplace_back(is_back(lumel) ? 2.0f : 1.0f);
    const Image map = to_map(house.lumels, light);
    for (std::size_t texel = 0; texel < house.lumels.coverage.size(); ++texel)
        EXPECT_EQ(map.values[4 * texel], house.lumels.coverage[texel] > 0.0f ? 1.0f : 0.0f);
}

TEST(Sides, AreFoundAgainInTheSolutionAndOutsideOfItRefused)
{
    const SolveScene house(house_under_sky(), AtlasOptions{.size = 96});
    Lumels lumels = house.lumels;
    const std::vector<glm::vec3> light(lumels.lumels.size(), glm::vec3(1.0f));
    const test::TemporaryFolder folder;
    const std::string path = folder / "solution.exr";
    write_solution(path, lumels, light, house.open);
    const StoredSolution solution = read_solution(path);
    ASSERT_EQ(solution.charts.back_shift.size(), lumels.back_shift.size());
    EXPECT_EQ(solution.charts.back_shift, lumels.back_shift);
    for (const glm::ivec2& strange : {glm::ivec2(95, 0), glm::ivec2(0, -96)}) {
        lumels.back_shift.assign(lumels.back_shift.size(), strange);
        write_solution(path, lumels, light, house.open);
        EXPECT_THROW(read_solution(path), Error);
    }
}

TEST(Sides, HaveTheirErrorsWhereTheMapShowsThem)
{
    const SolveScene house(house_under_sky(), AtlasOptions{.size = 96});
    const Lumels& lumels = house.lumels;
    std::vector<float> error;
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i)
        error.push_back(is_back(lumels.lumels[i]) ? 0.5f : 0.25f);
    const test::TemporaryFolder folder;
    const std::string path = folder / "solution.exr";
    std::vector<glm::vec3> light;
    for (const Lumel& lumel : lumels.lumels)
        light.emplace_back(is_back(lumel) ? 2.0f : 1.0f);
    write_solution(path, lumels, light, house.open);
    EXPECT_FALSE(find_exr_layer(path, kErrorLayer));
    write_solution(path, lumels, light, house.open, error);
    const std::optional<Image> map = find_exr_layer(path, kErrorLayer);
    ASSERT_TRUE(map);
    // The brighter side is shown where both share texels.
    const std::vector<std::uint32_t> shown = shown_lumels(lumels, light);
    std::size_t of_each_side[2] = {}, gutters = 0;
    for (std::size_t texel = 0; texel < shown.size(); ++texel) {
        const float found = map->values[4 * texel];
        if (shown[texel] == kNoLumel) {
            gutters += found > 0.0f ? 1 : 0;
            continue;
        }
        const Lumel& lumel = lumels.lumels[shown[texel]];
        if (lumel.flags & kLumelBuried)
            continue;
        EXPECT_EQ(found, error[shown[texel]]);
        ++of_each_side[is_back(lumel) ? 1 : 0];
    }
    EXPECT_GT(of_each_side[0], 0u);
    EXPECT_GT(of_each_side[1], 0u);
    EXPECT_GT(gutters, 0u);
}

TEST(Sides, ShareNoTexel)
{
    const SolveScene house(house_under_sky(), AtlasOptions{.size = 96});
    std::vector<int> lumels_at(house.lumels.coverage.size(), 0);
    for (const Lumel& lumel : house.lumels.lumels)
        if (lumel.instance < kFirstOfBlock)
            ++lumels_at[map_texel(house.lumels, lumel)];
    EXPECT_EQ(*std::max_element(lumels_at.begin(), lumels_at.end()), 1);
}

}  // namespace
}  // namespace lumel
