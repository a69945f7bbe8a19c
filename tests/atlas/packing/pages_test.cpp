// A map that is spread over several pages.

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "shapes.h"

namespace lumel::test {
namespace {

constexpr int kSide = 256;

/// Houses of many sizes in a row.
Scene street(int houses)
{
    Scene scene = empty_scene();
    std::mt19937 random(7);
    std::uniform_real_distribution<float> size(0.5f, 4.0f);
    float along = 0.0f;
    for (int i = 0; i < houses; ++i) {
        const int house = add_mesh(scene, {box({size(random), size(random), size(random)})});
        add_instance(scene, house, glm::translate(glm::mat4(1.0f), glm::vec3(along, 0.0f, 0.0f)));
        along += 5.0f;
    }
    return scene;
}

/// The same as one mesh of one primitive.
Scene terrace(int houses)
{
    const Scene apart = street(houses);
    Primitive all;
    for (const Instance& instance : apart.instances) {
        const Primitive& house = apart.meshes[std::size_t(instance.mesh)].primitives.front();
        const auto first = std::uint32_t(all.positions.size());
        for (const glm::vec3& p : house.positions)
            all.positions.emplace_back(instance.transform * glm::vec4(p, 1.0f));
        for (const std::uint32_t index : house.indices)
            all.indices.push_back(first + index);
    }
    Scene scene = empty_scene();
    add_instance(scene, add_mesh(scene, {all}), glm::mat4(1.0f));
    return scene;
}

/// Column and row of the cell of kSide × kSide texels that holds all of a surface; (-1, -1) if
/// none does.
glm::ivec2 cell_of(const Surface& surface)
{
    glm::vec2 low(1e30f), high(-1e30f);
    for (const glm::vec2& place : surface.texcoord) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    const glm::ivec2 cell = glm::ivec2(glm::floor(low / float(kSide)));
    const bool inside = glm::all(glm::lessThanEqual(high, float(kSide) * glm::vec2(cell + 1)));
    return inside ? cell : glm::ivec2(-1);
}

double area_in_map(const Surface& surface)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) {
            return glm::dvec2(surface.texcoord[surface.indices[i + k]]);
        };
        const glm::dvec2 u = at(1) - at(0), v = at(2) - at(0);
        sum += 0.5 * std::abs(u.x * v.y - u.y * v.x);
    }
    return sum;
}

TEST(Pages, EverySurfaceLiesOnOnePageAndNoTwoShareATexel)
{
    const Atlas atlas =
        make_atlas(street(60), {.texels_per_metre = 12.0f, .max_size = kSide, .pages = 16});
    ASSERT_GT(atlas.pages.count, 2);
    EXPECT_EQ(atlas.pages.side, kSide);
    EXPECT_EQ(atlas.width, atlas.height);
    for (const Surface& surface : atlas.surfaces) {
        const glm::ivec2 cell = cell_of(surface);
        ASSERT_GE(cell.x, 0) << "on the rim of two pages";
        for (const std::uint16_t page : pages_of_vertices(atlas.pages, surface))
            EXPECT_EQ(cell.y * (atlas.width / kSide) + cell.x, page);
    }
    int shared = 0;
    texel_owners(atlas, shared);
    EXPECT_EQ(shared, 0);
}

TEST(Pages, AllHaveTheDensityThatWasAskedFor)
{
    const Scene scene = street(60);
    const Atlas atlas =
        make_atlas(scene, {.texels_per_metre = 12.0f, .max_size = kSide, .pages = 16});
    EXPECT_TRUE(atlas.notes.empty());
    std::array<double, 16> texels{}, metres{};
    for (const Surface& surface : atlas.surfaces) {
        const std::size_t page = pages_of_vertices(atlas.pages, surface).front();
        texels[page] += area_in_map(surface);
        Scene alone = scene;
        alone.instances = {scene.instances[surface.instance]};
        metres[page] += world_area(alone);
    }
    for (int page = 0; page < atlas.pages.count; ++page)  // sides are whole texels
        EXPECT_NEAR(std::sqrt(texels[std::size_t(page)] / metres[std::size_t(page)]), 12.0, 0.12)
            << "page " << page;
}

TEST(Pages, AreAsFewAsThreeQuartersOfThemCanHold)
{
    const Scene scene = street(60);
    const Atlas atlas = make_atlas(
        scene, {.texels_per_metre = 12.0f, .max_size = kSide, .pages = 100, .gutter = 0});
    const double texels = 12.0 * 12.0 * world_area(scene);
    EXPECT_LE(atlas.pages.count, std::ceil(texels / (0.75 * kSide * kSide)));
}

TEST(Pages, OneIsUsedWhereItIsEnough)
{
    const Scene scene = street(6);
    const AtlasOptions one{.texels_per_metre = 8.0f, .max_size = kSide};
    AtlasOptions many = one;
    many.pages = 9;
    const Atlas a = make_atlas(scene, one), b = make_atlas(scene, many);
    EXPECT_EQ(b.pages.count, 1);
    EXPECT_EQ(a.width, b.width);
    for (std::size_t s = 0; s < a.surfaces.size(); ++s)
        EXPECT_EQ(a.surfaces[s].texcoord, b.surfaces[s].texcoord);
}

/// Four times the texels are twice the density, but for what gutters and corners of pages take.
Atlas expect_twice_as_dense_on_four(const Scene& scene)
{
    const Atlas one = make_atlas(scene, {.size = kSide});
    Atlas four = make_atlas(scene, {.size = kSide, .pages = 4});
    EXPECT_EQ(four.pages.count, 4);
    EXPECT_NEAR(four.texels_per_metre / one.texels_per_metre, 2.0, 0.15);
    return four;
}

TEST(Pages, OfAGivenSizeAreFilled)
{
    expect_twice_as_dense_on_four(street(60));
}

TEST(Pages, OfOnePrimitiveAreTwiceAsDenseOnFour)
{
    const Atlas four = expect_twice_as_dense_on_four(terrace(60));
    int shared = 0;
    texel_owners(four, shared);
    EXPECT_EQ(shared, 0);
}

TEST(Pages, CutNoChart)
{
    const Atlas atlas = make_atlas(terrace(60), {.size = kSide, .pages = 4});
    const Surface& surface = atlas.surfaces.at(0);
    std::map<std::uint32_t, std::set<int>> cells;  // of each chart's corners
    for (std::size_t k = 0; k < surface.indices.size(); ++k) {
        // Half a gutter lies between charts and the rims of pages.
        const glm::ivec2 cell(glm::floor(surface.texcoord[surface.indices[k]] / float(kSide)));
        cells[surface.chart[k / 3]].insert(cell.y * 2 + cell.x);
    }
    std::set<int> all;
    for (const auto& [chart, of_chart] : cells) {
        EXPECT_EQ(of_chart.size(), 1u) << "chart " << chart;
        all.insert(of_chart.begin(), of_chart.end());
    }
    EXPECT_EQ(all.size(), 4u);
}

TEST(Pages, DivideAPrimitiveOnlyWhereOneCannotHoldIt)
{
    Scene scene = street(12);
    const double area = world_area(scene);
    const auto density = float(std::sqrt(2.0 * kSide * kSide / area));  // two pages full, or three
    const Atlas atlas =
        make_atlas(scene, {.texels_per_metre = density, .max_size = kSide, .pages = 16});
    ASSERT_GT(atlas.pages.count, 1);
    for (const Surface& surface : atlas.surfaces)
        EXPECT_EQ(triangles_of_pages(atlas.pages, surface).size(), 1u);
}

TEST(Pages, AreLoweredInDensityTogetherWhereTheyAreTooFew)
{
    const Atlas atlas =
        make_atlas(street(60), {.texels_per_metre = 40.0f, .max_size = kSide, .pages = 3});
    EXPECT_LE(atlas.pages.count, 3);
    EXPECT_LT(atlas.texels_per_metre, 40.0f);
    ASSERT_EQ(atlas.notes.size(), 1u);
    EXPECT_NE(atlas.notes[0].find("limited to 3 × 256 × 256"), std::string::npos) << atlas.notes[0];
}

TEST(Pages, MoreThanAnImageHoldsAreRefused)
{
    EXPECT_THROW(make_atlas(street(2), {.max_size = 8192, .pages = 5}), Error);
    EXPECT_NO_THROW(make_atlas(street(2), {.max_size = 8192, .pages = 4}));
}

}  // namespace
}  // namespace lumel::test
