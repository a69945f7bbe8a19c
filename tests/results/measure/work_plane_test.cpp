#include "results/measure/work_plane.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/core/error.h"

using namespace lumel;

TEST(WorkPlane, PointsLieTheSpacingApartWithEvenMargins)
{
    const PlaneGrid grid =
        points_on({.height = 0.8, .spacing = 0.5, .low = {1.0, -2.0}, .high = {3.2, -0.5}});
    ASSERT_EQ(grid.columns, 4);
    ASSERT_EQ(grid.rows, 3);
    ASSERT_EQ(grid.points.size(), 12u);
    EXPECT_NEAR(grid.points.front().x - 1.0, 3.2 - grid.points.back().x, 1e-12);
    EXPECT_NEAR(grid.points.front().z + 2.0, -0.5 - grid.points.back().z, 1e-12);
    EXPECT_NEAR(grid.points[1].x - grid.points[0].x, 0.5, 1e-12);
    EXPECT_NEAR(grid.points[4].z - grid.points[0].z, 0.5, 1e-12);
    EXPECT_EQ(grid.points[7].y, 0.8);
}

TEST(WorkPlane, ThatIsSmallerThanTheSpacingHasItsMiddle)
{
    const PlaneGrid grid = points_on({.spacing = 9.0, .low = {0.0, 0.0}, .high = {2.0, 4.0}});
    ASSERT_EQ(grid.points.size(), 1u);
    EXPECT_EQ(grid.points[0], glm::dvec3(1.0, 0.0, 2.0));
}

TEST(WorkPlane, OfTooManyPointsIsRefused)
{
    EXPECT_THROW(points_on({.spacing = 1e-4, .low = {0.0, 0.0}, .high = {1.0, 1.0}}), Error);
}

TEST(WorkPlane, FiguresLeaveOutWhatIsInside)
{
    const std::vector<Reading> readings = {
        {.lux = 100.0, .noise = 3.0}, {.lux = 1.0, .inside = true}, {.lux = 300.0, .noise = 4.0}};
    const PlaneFigures figures = figures_of(readings);
    EXPECT_EQ(figures.count, 2u);
    EXPECT_EQ(figures.least, 100.0);
    EXPECT_EQ(figures.mean, 200.0);
    EXPECT_EQ(figures.most, 300.0);
    EXPECT_EQ(figures.uniformity, 0.5);
    EXPECT_EQ(figures.noise_of_mean, 2.5);
}
