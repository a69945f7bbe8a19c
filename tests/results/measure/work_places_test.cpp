#include "results/measure/work_places.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/core/error.h"

using namespace lumel;

namespace {

FloorArea cell_of(const AreaPoint& point)
{
    return {point.at - 0.5 * point.cell, point.at + 0.5 * point.cell};
}

double size_of(const AreaPoints& area)
{
    double size = 0.0;
    for (const AreaPoint& point : area.points)
        size += point.cell.x * point.cell.y;
    return size;
}

}  // namespace

// The standard's own examples: areas of 1, 5, 10, 50 and 100 m need points 0.2, 0.6, 1, 3 and 5 m
// apart.
TEST(WorkPlaces, PointsAreAsFarApartAsTheStandardSays)
{
    const auto spacing = [](double side) { return grid_spacing({{0.0, 0.0}, {side, side}}); };
    EXPECT_NEAR(spacing(1.0), 0.2, 1e-9);
    EXPECT_NEAR(spacing(5.0), 0.6, 0.02);
    EXPECT_NEAR(spacing(10.0), 1.0, 1e-9);
    EXPECT_NEAR(spacing(50.0), 3.0, 0.1);
    EXPECT_NEAR(spacing(100.0), 5.0, 1e-9);
    EXPECT_EQ(spacing(1e6), 10.0);
}

TEST(WorkPlaces, LongAreasAreGriddedByTheirWidth)
{
    EXPECT_NEAR(grid_spacing({{0.0, 0.0}, {30.0, 10.0}}), 1.0, 1e-9);
    EXPECT_GT(grid_spacing({{0.0, 0.0}, {19.0, 10.0}}), 1.2);
}

TEST(WorkPlaces, SurroundingsNeedAStepLessThanTheTask)
{
    const double steps[][2] = {{1000, 500}, {750, 500}, {500, 300}, {300, 200},
                               {200, 150},  {150, 150}, {100, 100}};
    for (const auto& [task, around] : steps) {
        EXPECT_EQ(surrounding_limits(task).illuminance, around) << task;
        EXPECT_NEAR(background_limits(task).illuminance, around / 3.0, 1e-9) << task;
    }
    EXPECT_EQ(surrounding_limits(500).uniformity, 0.4);
    EXPECT_EQ(background_limits(500).uniformity, 0.1);
}

// The room is 8 × 6 m, so that its areas are 7 × 5 m without the strip along the walls; a task of
// 4 × 3.5 m has a band of 0.5 m around it, as large as that: 5 × 4.5 m less the task.
TEST(WorkPlaces, CellsFillTheTaskItsSurroundingsAndTheRest)
{
    const FloorArea room{{0.0, 0.0}, {8.0, 6.0}}, task{{2.0, 1.5}, {6.0, 5.0}};
    const std::vector<AreaPoints> areas = points_in_areas(room, &task);
    ASSERT_EQ(areas.size(), 3u);
    EXPECT_NEAR(size_of(areas[0]), 4.0 * 3.5, 1e-9);
    EXPECT_NEAR(size_of(areas[1]), 5.0 * 4.5 - 4.0 * 3.5, 1e-9);
    EXPECT_NEAR(size_of(areas[2]), 7.0 * 5.0 - 5.0 * 4.5, 1e-9);
    for (const AreaPoints& area : areas)
        for (const AreaPoint& point : area.points) {
            const FloorArea cell = cell_of(point);
            EXPECT_LE(std::max(point.cell.x, point.cell.y), area.spacing + 1e-9);
            const bool is_in_task = cell.low.x > 1.999 && cell.high.x < 6.001 &&
                                    cell.low.y > 1.499 && cell.high.y < 5.001;
            EXPECT_EQ(is_in_task, area.area == RoomArea::task);
        }
}

TEST(WorkPlaces, ALargeTaskHasSurroundingsToo)
{
    const FloorArea room{{0.0, 0.0}, {20.0, 20.0}}, task{{3.0, 3.0}, {13.0, 12.0}};
    const std::vector<AreaPoints> areas = points_in_areas(room, &task);
    ASSERT_EQ(areas.size(), 3u);
    EXPECT_EQ(areas[1].area, RoomArea::surrounding);
    EXPECT_NEAR(size_of(areas[1]), 11.0 * 10.0 - 10.0 * 9.0, 1e-9);
}

TEST(WorkPlaces, ATaskMayReachTheWalls)
{
    const FloorArea room{{0.0, 0.0}, {8.0, 6.0}}, task{{-0.0005, 0.0}, {2.0, 1.0}};
    const std::vector<AreaPoints> areas = points_in_areas(room, &task);
    EXPECT_NEAR(size_of(areas[0]), 2.0, 1e-3);
}

TEST(WorkPlaces, WithoutATaskTheRoomIsOneButForAStripAlongItsWalls)
{
    const FloorArea room{{0.0, 0.0}, {8.0, 6.0}};
    const std::vector<AreaPoints> areas = points_in_areas(room, nullptr);
    ASSERT_EQ(areas.size(), 1u);
    EXPECT_NEAR(size_of(areas[0]), 7.0 * 5.0, 1e-9);
    for (const AreaPoint& point : areas[0].points) {
        EXPECT_GE(cell_of(point).low.x, 0.5 - 1e-9);
        EXPECT_LE(cell_of(point).high.y, 5.5 + 1e-9);
    }
}

TEST(WorkPlaces, RefusesRoomsTasksAndUsesThatAreNone)
{
    const FloorArea room{{0.0, 0.0}, {8.0, 6.0}}, outside{{7.0, 1.0}, {9.0, 2.0}},
        thin{{1.0, 1.0}, {2.0, 1.01}}, wall{{0.0, 0.0}, {8.0, 0.0}}, town{{0.0, 0.0}, {2e3, 2e3}};
    EXPECT_THROW(points_in_areas(room, &outside), Error);
    EXPECT_THROW(points_in_areas(room, &thin), Error);
    EXPECT_THROW(points_in_areas(wall, nullptr), Error);
    EXPECT_THROW(points_in_areas(town, nullptr), Error);
    EXPECT_THROW(room_use_named("offices"), Error);
    EXPECT_EQ(room_use_named("office").illuminance, 500.0);
}
