// A map that is spread over several pages.

#include <array>
#include <cmath>
#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "core/error.h"
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
        EXPECT_EQ(cell.y * (atlas.width / kSide) + cell.x, page_of(atlas.pages, surface));
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
        const auto page = std::size_t(page_of(atlas.pages, surface));
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

TEST(Pages, OfAGivenSizeAreFilled)
{
    const Scene scene = street(60);
    const Atlas one = make_atlas(scene, {.size = kSide});
    const Atlas four = make_atlas(scene, {.size = kSide, .pages = 4});
    EXPECT_EQ(four.pages.count, 4);
    // Four times the texels are twice the density, but for what gutters and corners of pages take.
    EXPECT_NEAR(four.texels_per_metre / one.texels_per_metre, 2.0, 0.15);
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
