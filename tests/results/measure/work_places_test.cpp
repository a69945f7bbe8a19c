#include "results/measure/work_places.h"

#include <gtest/gtest.h>

#include "base/core/error.h"

using namespace lumel;

namespace {

std::size_t count_of(const std::vector<AreaPoints>& areas, RoomArea kind)
{
    for (const AreaPoints& one : areas)
        if (one.area == kind)
            return one.places.size();
    return 0;
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

TEST(WorkPlaces, AreasOfARoomDoNotOverlap)
{
    const FloorArea room{{0.0, 0.0}, {8.0, 6.0}}, task{{1.0, 1.0}, {3.0, 2.0}};
    const FloorArea around{{0.5, 0.5}, {3.5, 2.5}};
    const std::vector<AreaPoints> areas = points_in_areas(room, &task, 0.75);
    ASSERT_EQ(areas.size(), 3u);
    for (const AreaPoints& area : areas)
        for (const glm::dvec3& place : area.places) {
            const glm::dvec2 at(place.x, place.z);
            EXPECT_EQ(place.y, 0.75);
            EXPECT_EQ(task.contains(at), area.area == RoomArea::task);
            EXPECT_EQ(around.contains(at), area.area != RoomArea::background);
        }
}

TEST(WorkPlaces, WithoutATaskTheRoomIsOneButForAStripAlongItsWalls)
{
    const std::vector<AreaPoints> areas = points_in_areas({{0.0, 0.0}, {8.0, 6.0}}, nullptr, 0.75);
    ASSERT_EQ(areas.size(), 1u);
    EXPECT_GT(count_of(areas, RoomArea::task), 50u);
    for (const glm::dvec3& place : areas.front().places) {
        EXPECT_GE(place.x, kSurroundingWidth);
        EXPECT_LE(place.x, 8.0 - kSurroundingWidth);
        EXPECT_GE(place.z, kSurroundingWidth);
        EXPECT_LE(place.z, 6.0 - kSurroundingWidth);
    }
}

TEST(WorkPlaces, RefusesATaskOutsideOfTheRoomAndAnUnknownUse)
{
    const FloorArea task{{7.0, 1.0}, {9.0, 2.0}};
    EXPECT_THROW(points_in_areas({{0.0, 0.0}, {8.0, 6.0}}, &task, 0.75), Error);
    EXPECT_THROW(room_use_named("offices"), Error);
    EXPECT_EQ(room_use_named("office").illuminance, 500.0);
}
