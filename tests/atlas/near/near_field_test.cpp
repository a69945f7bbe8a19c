// The table of near pairs: closure, reciprocity, occlusion, and what counts as near.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "../../support/closed_forms.h"
#include "atlas/near/near_field.h"

namespace lumel {
namespace {

using support::add_lumels;
using support::add_quad;
using support::box_walls;
using support::HandMade;
using support::make_quads;
using support::Quad;

constexpr float kEverything = 1e3f;  ///< a radius that makes all pairs near

HandMade closed_box(int resolution)
{
    Quad look;
    look.res_u = look.res_v = resolution;
    const auto walls = box_walls(glm::vec3(0.0f), glm::vec3(1.0f), true, look);
    return make_quads({walls.begin(), walls.end()});
}

NearField build(const HandMade& made, const NearFieldOptions& options)
{
    return build_near_field(made.scene, RayScene(made.scene), made.lumels, options);
}

float entry(const NearField& table, std::size_t i, std::size_t j)
{
    for (std::uint32_t k = table.first[i]; k < table.first[i + 1]; ++k)
        if (table.column[k] == j)
            return table.factor[k];
    return 0.0f;
}

float row_sum(const NearField& table, std::size_t i)
{
    float sum = 0.0f;
    for (std::uint32_t k = table.first[i]; k < table.first[i + 1]; ++k)
        sum += table.factor[k];
    return sum;
}

TEST(NearField, RowsOfAClosedBoxSumToOneIfAllPairsAreNear)
{
    const HandMade box = closed_box(2);
    for (const bool centre : {false, true}) {
        NearFieldOptions options;
        options.radius = kEverything;
        options.centre = centre;
        const NearField table = build(box, options);
        for (std::size_t i = 0; i < box.lumels.lumels.size(); ++i)
            EXPECT_NEAR(row_sum(table, i), 1.0f, centre ? 1e-4f : 2e-3f) << i << " " << centre;
    }
}

// Beyond a few sizes pairs are sampled, so a row closes in the mean and each within its noise.
TEST(NearField, RowsOfAFinelyCutBoxSumToOneInTheMean)
{
    const HandMade box = closed_box(8);
    NearFieldOptions options;
    options.radius = kEverything;
    const NearField table = build(box, options);
    double mean = 0.0;
    for (std::size_t i = 0; i < box.lumels.lumels.size(); ++i) {
        mean += double(row_sum(table, i)) / double(box.lumels.lumels.size());
        EXPECT_NEAR(row_sum(table, i), 1.0f, 0.05f) << i;
    }
    EXPECT_NEAR(mean, 1.0, 2e-3);
}

TEST(NearField, MatchesTheClosedFormsOfUnitSquares)
{
    const HandMade box = closed_box(1);
    NearFieldOptions options;
    options.radius = kEverything;
    const NearField table = build(box, options);
    EXPECT_NEAR(entry(table, 0, 1), opposed_rectangles(1.0, 1.0, 1.0), 1e-4);
    EXPECT_NEAR(entry(table, 0, 2), adjoined_rectangles(1.0, 1.0, 1.0), 1.5e-3);
}

/// A floor and a wall that meet at an edge, with so many lumels along u and v.
std::vector<Quad> corner(const glm::ivec2& floor_lumels, const glm::ivec2& wall_lumels)
{
    Quad floor, wall;
    floor.edge_u = {0, 0, 1};
    floor.edge_v = {1, 0, 0};
    floor.res_u = floor_lumels.x;
    floor.res_v = floor_lumels.y;
    wall.res_u = wall_lumels.x;
    wall.res_v = wall_lumels.y;
    return {floor, wall};
}

TEST(NearField, HoldsNearPairsOnlyInAscendingOrder)
{
    const HandMade box = closed_box(16);
    const NearFieldOptions options;
    const NearField table = build(box, options);
    ASSERT_EQ(table.first.size(), box.lumels.lumels.size() + 1);
    ASSERT_GT(table.column.size(), 0u);
    for (std::size_t i = 0; i < box.lumels.lumels.size(); ++i)
        for (std::uint32_t k = table.first[i]; k < table.first[i + 1]; ++k) {
            const Lumel& a = box.lumels.lumels[i];
            const Lumel& b = box.lumels.lumels[table.column[k]];
            EXPECT_TRUE(is_near(a.position, a.size, b.position, b.size, options.radius));
            EXPECT_TRUE(k == table.first[i] || table.column[k - 1] < table.column[k]);
        }
}

TEST(NearField, FindsEveryNearPairAlsoBetweenVeryDifferentSizes)
{
    // A floor of few large lumels and a wall of many small ones that meet at a corner.
    const HandMade made = make_quads(corner({2, 2}, {64, 64}));
    NearFieldOptions options;
    options.centre = true;
    const NearField table = build(made, options);
    for (std::size_t i = 0; i < made.first[1]; ++i)
        for (std::size_t j = made.first[1]; j < made.first[2]; ++j) {
            const Lumel& a = made.lumels.lumels[i];
            const Lumel& b = made.lumels.lumels[j];
            const bool near = is_near(a.position, a.size, b.position, b.size, options.radius);
            ASSERT_EQ(entry(table, i, j) > 0.0f, near) << i << " " << j;
            ASSERT_EQ(entry(table, j, i) > 0.0f, near) << i << " " << j;
        }
}

TEST(NearField, IsReciprocal)
{
    const HandMade made = make_quads(corner({3, 5}, {7, 4}));
    const NearField table = build(made, {});
    for (std::size_t i = 0; i < made.lumels.lumels.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const float there = made.lumels.lumels[i].area * entry(table, i, j);
            const float back = made.lumels.lumels[j].area * entry(table, j, i);
            EXPECT_NEAR(there, back, 1e-5f * there);
        }
}

TEST(NearField, IsZeroBetweenOccludedPairsAndHalfBehindAHalfScreen)
{
    Quad below, above, screen;
    below.edge_u = {0, 0, 1};
    below.edge_v = {1, 0, 0};
    above.corner = {0, 1, 0};
    above.edge_u = {1, 0, 0};
    above.edge_v = {0, 0, 1};
    screen.corner = {-1, 0.5f, -1};
    screen.edge_u = {3, 0, 0};
    screen.edge_v = {0, 0, 3};
    const float open = entry(build(make_quads({below, above}), {}), 0, 1);
    EXPECT_GT(open, 0.19f);
    EXPECT_EQ(entry(build(make_quads({below, above, screen}), {}), 0, 1), 0.0f);

    // Close to the upper plate, a screen over half of it hides half of it.
    screen.corner = {-1, 0.999f, -1};
    screen.edge_u = {1.5f, 0, 0};
    const float half = entry(build(make_quads({below, above, screen}), {}), 0, 1);
    EXPECT_NEAR(half, 0.5f * open, 0.03f * open);
}

TEST(NearField, OfAMirroredInstanceIsTheMirrorImage)
{
    const std::vector<Quad> quads = corner({3, 3}, {3, 3});
    const glm::mat4 mirror(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    const HandMade plain = make_quads(quads);
    HandMade mirrored;
    for (const Quad& quad : quads) {
        add_lumels(mirrored.lumels, quad, std::uint32_t(mirrored.scene.instances.size()), mirror);
        add_quad(mirrored.scene, quad, mirror);
    }
    const NearField a = build(plain, {}), b = build(mirrored, {});
    ASSERT_EQ(a.column, b.column);
    ASSERT_GT(a.column.size(), 0u);
    for (std::size_t k = 0; k < a.factor.size(); ++k)
        EXPECT_NEAR(a.factor[k], b.factor[k], 1e-5f);
}

TEST(NearField, IsTheSameForALumelCutIntoTriangles)
{
    const HandMade whole = closed_box(1);
    HandMade cut = whole;
    cut.lumels.pieces.clear();
    for (Lumel& lumel : cut.lumels.lumels) {
        Piece lower = whole.lumels.pieces[lumel.first_piece], upper = lower;
        lower.share = 0.5f;
        lower.parallelogram = upper.parallelogram = 0;
        upper.origin += upper.edge_u + upper.edge_v;
        upper.edge_u = -upper.edge_u;
        upper.edge_v = -upper.edge_v;
        lumel.first_piece = std::uint32_t(cut.lumels.pieces.size());
        lumel.piece_count = 2;
        cut.lumels.pieces.insert(cut.lumels.pieces.end(), {lower, upper});
    }
    NearFieldOptions options;
    options.radius = kEverything;
    const NearField a = build(whole, options), b = build(cut, options);
    ASSERT_EQ(a.column, b.column);
    for (std::size_t k = 0; k < a.factor.size(); ++k)
        EXPECT_NEAR(a.factor[k], b.factor[k], 3e-3f);
}

TEST(NearField, ACutOutShooterCountsByItsOpacity)
{
    HandMade box = closed_box(1);
    NearFieldOptions options;
    options.centre = true;
    const float opaque = entry(build(box, options), 0, 1);
    box.lumels.lumels[1].area *= 0.25f;
    EXPECT_NEAR(entry(build(box, options), 0, 1), 0.25f * opaque, 1e-6f);
}

TEST(NearField, NoRowExceedsOneInAGapMuchNarrowerThanALumel)
{
    Quad left, right;
    left.res_u = 5;
    left.res_v = 4;
    right.corner = {1, 0, 1e-3f};  // faces the first, its lumels not aligned with theirs
    right.edge_u = {-1, 0, 0};
    right.res_u = 3;
    right.res_v = 7;
    const HandMade made = make_quads({left, right});
    NearFieldOptions options;
    const NearField table = build(made, options);
    for (std::size_t i = 0; i < made.lumels.lumels.size(); ++i) {
        EXPECT_LE(row_sum(table, i), 1.0f + 1e-5f) << i;
        EXPECT_GT(row_sum(table, i), 0.7f) << i;
    }
}

TEST(NearField, LeavesBuriedLumelsOut)
{
    HandMade box = closed_box(4);
    box.lumels.lumels[5].flags |= kLumelBuried;
    const NearField table = build(box, {});
    EXPECT_EQ(table.first[5], table.first[6]);
    for (const std::uint32_t column : table.column)
        EXPECT_NE(column, 5u);
}

TEST(NearField, IsTheSameOnEveryRun)
{
    const HandMade box = closed_box(12);
    const NearField a = build(box, {}), b = build(box, {});
    EXPECT_EQ(a.column, b.column);
    EXPECT_EQ(a.factor, b.factor);
}

}  // namespace
}  // namespace lumel
