// Cells of lumels, and sub-lumels.

#include <vector>

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "atlas/cells/cells.h"

namespace lumel {
namespace {

using support::HandMade;
using support::Quad;

/// A floor of one lumel, divided into strips of two triangles each, as beside something that covers
/// a part of it.
HandMade floor_in(int strips)
{
    Quad quad;
    quad.res_u = quad.res_v = 1;
    HandMade made = support::make_quads({quad});
    const Piece whole = made.lumels.pieces.front();
    made.lumels.pieces.clear();
    for (int n = 0; n < 2 * strips; ++n) {
        Piece piece = whole;
        piece.parallelogram = 0;
        piece.edge_u = whole.edge_u / float(strips);
        piece.origin = whole.origin + float(n / 2) * piece.edge_u;
        if (n % 2 == 1) {
            piece.origin += piece.edge_u + piece.edge_v;
            piece.edge_u = -piece.edge_u;
            piece.edge_v = -piece.edge_v;
        }
        piece.share = float(n + 1) / float(2 * strips);
        made.lumels.pieces.push_back(piece);
    }
    made.lumels.lumels.front().piece_count = std::uint32_t(2 * strips);
    return made;
}

class CellsOfStrips : public testing::TestWithParam<int> {};

TEST_P(CellsOfStrips, HaveAPointInEachCell)
{
    const HandMade made = floor_in(GetParam());
    const RayScene rays(made.scene);
    const WorldLumels world(made.scene, rays, made.lumels);
    const Cells cells(world);
    const CellPoints points = cell_points(world, cells, 0);
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c) {
        ASSERT_TRUE(points.has(c)) << c;
        EXPECT_EQ(cells.cell(0, points.point[c].position), c);
    }
}

TEST_P(CellsOfStrips, AreOneSubLumelInTheOpen)
{
    const HandMade made = floor_in(GetParam());
    const RayScene rays(made.scene);
    const WorldLumels world(made.scene, rays, made.lumels);
    const Cells cells(world);
    EXPECT_FALSE(SubLumels(world, cells, rays, made.lumels, {0}, 1).is_cut(0));
}

/// A wall 4 % from the edge of a lumel hides a sliver without a cell.
TEST(Sliver, IsASubLumelWithoutCells)
{
    Quad floor;  // faces +z
    floor.res_u = floor.res_v = 1;
    Quad wall;
    wall.corner = {0.04f, 0.0f, 0.0f};
    wall.edge_u = {0.0f, 1.0f, 0.0f};
    wall.edge_v = {0.0f, 0.0f, 1.0f};
    wall.double_sided = true;
    const HandMade made = support::make_quads({floor, wall});
    const RayScene rays(made.scene);
    const WorldLumels world(made.scene, rays, made.lumels);
    const Cells cells(world);
    const SubLumels parts(world, cells, rays, made.lumels, {0, 1}, 1);
    ASSERT_TRUE(parts.has_hidden(0));
    EXPECT_FALSE(parts.is_cut(0));
    EXPECT_EQ(parts.end(0) - parts.first(0), 2u);
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c)
        EXPECT_EQ(parts.part(0, c), parts.first(0));
    const SeenCells seen = parts.seen_cells(0);
    const glm::vec3 up(0.0f, 0.0f, 1.0f);
    const std::uint32_t cell = seen.nearest({{0.02f, 0.5f, 0.0f}, up});
    EXPECT_EQ(cell, kNoCell);
    EXPECT_EQ(parts.part(0, cell), parts.end(0) - 1);
    EXPECT_NE(seen.nearest({{0.06f, 0.5f, 0.0f}, up}), kNoCell);
}

INSTANTIATE_TEST_SUITE_P(Of, CellsOfStrips, testing::Values(1, 2, 3, 5, 8));

}  // namespace
}  // namespace lumel
