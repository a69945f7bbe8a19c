// Published numbers, and the sums that must close.

#include "../support/closed_forms.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lumel {
namespace {

TEST(ClosedForms, OpposedRectanglesMatchTheCatalog)
{
    EXPECT_NEAR(opposed_rectangles(1, 1, 1), 0.199825, 1e-6);
    EXPECT_NEAR(opposed_rectangles(1, 1, 0.5), 0.415253, 1e-6);
    EXPECT_NEAR(opposed_rectangles(1, 1, 2), 0.068590, 1e-6);
    EXPECT_NEAR(opposed_rectangles(2, 1, 1), 0.285875, 1e-6);
    EXPECT_NEAR(opposed_rectangles(4, 4, 3), 0.282733, 1e-6);
    EXPECT_NEAR(opposed_rectangles(10, 10, 1), 0.826995, 1e-6);
}

TEST(ClosedForms, AdjoinedRectanglesMatchTheCatalog)
{
    EXPECT_NEAR(adjoined_rectangles(1, 1, 1), 0.200044, 1e-6);
    EXPECT_NEAR(adjoined_rectangles(1, 2, 1), 0.232853, 1e-6);
    EXPECT_NEAR(adjoined_rectangles(2, 1, 1), 0.116426, 1e-6);
    EXPECT_NEAR(adjoined_rectangles(4, 3, 4), 0.179317, 1e-6);
    EXPECT_NEAR(adjoined_rectangles(1, 0.5, 1), 0.146187, 1e-6);
}

TEST(ClosedForms, CoaxialDiscsMatchTheCatalog)
{
    EXPECT_NEAR(coaxial_discs(1, 1, 1), 0.381966, 1e-6);
    EXPECT_NEAR(coaxial_discs(0.5, 0.5, 1), 0.171573, 1e-6);
    EXPECT_NEAR(coaxial_discs(1, 2, 1), 0.763932, 1e-6);
    EXPECT_NEAR(point_to_coaxial_disc(0.5, 2), 0.058824, 1e-6);
}

TEST(ClosedForms, PointsUnderRectanglesMatchTheCatalog)
{
    EXPECT_NEAR(point_to_parallel_rectangle({0, 1}, {0, 1}, 1), 0.138532, 1e-6);
    EXPECT_NEAR(point_to_parallel_rectangle({-1, 1}, {-1, 1}, 1), 0.554126, 1e-6);
    EXPECT_NEAR(point_to_parallel_rectangle({0, 2}, {0, 2}, 3), 0.089421, 1e-6);
    EXPECT_NEAR(point_to_parallel_rectangle({-0.5, 0.5}, {-0.5, 0.5}, 3), 0.034107, 1e-6);
}

TEST(ClosedForms, PointsBesideWallsMatchTheCatalog)
{
    EXPECT_NEAR(point_to_perpendicular_rectangle({-2, 2}, {0, 1}, 0.25), 0.375888, 1e-6);
    EXPECT_NEAR(point_to_perpendicular_rectangle({-2, 2}, {0, 1}, 0.5), 0.270977, 1e-6);
    EXPECT_NEAR(point_to_perpendicular_rectangle({-2, 2}, {0, 1}, 2), 0.042243, 1e-6);
    EXPECT_NEAR(point_to_perpendicular_rectangle({-1e6, 1e6}, {0, 1}, 1), 0.146447, 1e-6);
    EXPECT_DOUBLE_EQ(point_to_perpendicular_rectangle({-1, 1}, {-5, 1}, 1),
                     point_to_perpendicular_rectangle({-1, 1}, {0, 1}, 1));
}

TEST(ClosedForms, AnOpenBoxAroundAPointClosesToOne)
{
    // A point off-centre on the floor of a 2 x 3 x 1.5 room sees ceiling and four walls.
    const double ceiling = point_to_parallel_rectangle({-0.5, 1.5}, {-2.2, 0.8}, 1.5);
    const double walls = point_to_perpendicular_rectangle({-0.5, 1.5}, {0, 1.5}, 0.8) +
                         point_to_perpendicular_rectangle({-0.5, 1.5}, {0, 1.5}, 2.2) +
                         point_to_perpendicular_rectangle({-2.2, 0.8}, {0, 1.5}, 0.5) +
                         point_to_perpendicular_rectangle({-2.2, 0.8}, {0, 1.5}, 1.5);
    EXPECT_NEAR(ceiling + walls, 1.0, 1e-12);
}

TEST(ClosedForms, ACubeClosesToOne)
{
    EXPECT_NEAR(opposed_rectangles(1, 1, 1) + 4.0 * adjoined_rectangles(1, 1, 1), 1.0, 1e-12);
}

TEST(ClosedForms, PointsAverageToAreas)
{
    constexpr int kSide = 200;
    double parallel = 0.0, perpendicular = 0.0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const double px = (x + 0.5) / kSide, py = (y + 0.5) / kSide;
            parallel += point_to_parallel_rectangle({-px, 1 - px}, {-py, 1 - py}, 1);
            perpendicular += point_to_perpendicular_rectangle({-px, 1 - px}, {0, 1}, py);
        }
    EXPECT_NEAR(parallel / (kSide * kSide), opposed_rectangles(1, 1, 1), 1e-5);
    EXPECT_NEAR(perpendicular / (kSide * kSide), adjoined_rectangles(1, 1, 1), 1e-4);
}

TEST(ClosedForms, AFurnaceAddsUpItsBounces)
{
    EXPECT_DOUBLE_EQ(furnace_irradiance(1.0, 0.5), 2.0);
    double bounces = 0.0;
    for (int n = 0; n < 1000; ++n)
        bounces += std::pow(0.9, n);
    EXPECT_NEAR(furnace_irradiance(1.0, 0.9), bounces, 1e-9);
}

}  // namespace
}  // namespace lumel
