#include "results/measure/work_places.h"

#include <algorithm>
#include <cmath>

#include "base/core/error.h"

namespace lumel {
namespace {

/// Heights of tasks at a desk and on the floor [m].
constexpr double kDesk = 0.75, kFloor = 0.1;

constexpr RoomUse kUses[] = {
    {"office", "writing, typing, reading, data processing", 500, 0.6, kDesk},
    {"conference", "conference and meeting rooms", 500, 0.6, kDesk},
    {"drawing", "technical drawing", 750, 0.7, kDesk},
    {"cad", "CAD work stations", 500, 0.6, kDesk},
    {"copying", "filing, copying", 300, 0.4, kDesk},
    {"reception", "reception desks", 300, 0.6, kDesk},
    {"archive", "archives", 200, 0.4, kDesk},
    {"corridor", "corridors and circulation areas", 100, 0.4, kFloor},
    {"stairs", "stairs", 100, 0.4, kFloor},
    {"storeroom", "store rooms", 100, 0.4, kFloor},
    {"canteen", "canteens, pantries", 200, 0.4, kDesk},
    {"washroom", "cloakrooms, washrooms, toilets", 200, 0.4, kFloor},
    {"classroom", "classrooms: general activities", 500, 0.6, kDesk},
    {"lecture", "lecture halls", 500, 0.6, kDesk},
    {"library", "libraries: reading areas", 500, 0.6, kDesk},
    {"shelves", "libraries: bookshelves", 200, 0.4, kDesk},
    {"sports", "sports halls, gymnasiums", 300, 0.6, kFloor},
    {"shop", "shops: sales areas", 300, 0.4, kDesk},
    {"till", "shops: till areas", 500, 0.6, kDesk},
    {"kitchen", "restaurants: kitchens", 500, 0.6, kDesk},
    {"waiting", "health care: waiting rooms", 200, 0.4, kDesk},
    {"assembly-rough", "metal working, assembly: rough", 200, 0.6, kDesk},
    {"assembly-medium", "metal working, assembly: medium", 300, 0.6, kDesk},
    {"assembly-fine", "metal working, assembly: fine", 500, 0.6, kDesk},
    {"assembly-precision", "metal working, assembly: precision", 750, 0.7, kDesk},
};

/// Illuminance of surroundings by that of the task [lx]: of the first row that it reaches.
struct SurroundingRow {
    double task, surrounding;
};
constexpr SurroundingRow kSurroundings[] = {{750, 500}, {500, 300}, {300, 200}, {200, 150}};
constexpr double kSurroundingUniformity = 0.4, kBackgroundUniformity = 0.1;
/// Background relative to surroundings.
constexpr double kBackgroundShare = 1.0 / 3.0;

/// Of the spacing of points: p = kFactor · kBase^log10(d), at most kWidest [m].
constexpr double kFactor = 0.2, kBase = 5.0, kWidest = 10.0;
/// Areas longer than this × their width are gridded by their width.
constexpr double kLong = 2.0;

/// Width of the immediate surrounding area, and of the strip along walls where nothing is measured
/// but tasks [m].
constexpr double kStrip = 0.5;
/// Parts of areas thinner than this have no points [m].
constexpr double kThin = 0.1;
/// Rounding of coordinates in files and on the command line [m].
constexpr double kRounding = 1e-3;

/// Adds points at most `spacing` apart.
void add_points(const FloorArea& part, double spacing, std::vector<AreaPoint>& points)
{
    const glm::dvec2 size = part.size();
    const double thin = std::min(size.x, size.y);
    if (thin < kThin)
        return;
    const glm::dvec2 counts = glm::ceil(size / std::min(spacing, thin) - kRounding);
    if (double(points.size()) + counts.x * counts.y > kMaxRoomPoints)
        throw Error(ErrorKind::input, "--bounds",
                    "make more than 10,000 points; give the corners of one room");
    const glm::dvec2 cell = size / counts;
    for (double row = 0.5; row < counts.y; ++row)
        for (double column = 0.5; column < counts.x; ++column)
            points.push_back({part.low + cell * glm::dvec2(column, row), cell});
}

AreaPoints points_of(RoomArea kind, const FloorArea& area)
{
    AreaPoints result{.area = kind, .spacing = grid_spacing(area)};
    add_points(area, result.spacing, result.points);
    return result;
}

/// Points of an area with a hole in it, by the four parts around the hole.
AreaPoints points_around(RoomArea kind, const FloorArea& area, const FloorArea& hole)
{
    AreaPoints result{.area = kind, .spacing = grid_spacing(area)};
    const FloorArea parts[] = {{area.low, {area.high.x, hole.low.y}},
                               {{area.low.x, hole.low.y}, {hole.low.x, hole.high.y}},
                               {{hole.high.x, hole.low.y}, {area.high.x, hole.high.y}},
                               {{area.low.x, hole.high.y}, area.high}};
    for (const FloorArea& part : parts)
        add_points(part, result.spacing, result.points);
    return result;
}

}  // namespace

std::string names_of_room_uses()
{
    std::string names;
    for (const RoomUse& use : kUses)
        names += (names.empty() ? "" : ", ") + std::string(use.name);
    return names;
}

const RoomUse& room_use_named(const std::string& name)
{
    const auto* const use = std::ranges::find(kUses, name, &RoomUse::name);
    if (use == std::end(kUses))
        throw Error(ErrorKind::input, "--en12464 " + name,
                    "is no use of a room; known are " + names_of_room_uses());
    return *use;
}

AreaLimits surrounding_limits(double task)
{
    const auto* const row = std::ranges::find_if(
        kSurroundings, [&](const SurroundingRow& one) { return task >= one.task; });
    return {row != std::end(kSurroundings) ? row->surrounding : task, kSurroundingUniformity};
}

AreaLimits background_limits(double task)
{
    return {kBackgroundShare * surrounding_limits(task).illuminance, kBackgroundUniformity};
}

double grid_spacing(const FloorArea& area)
{
    const glm::dvec2 size = area.size();
    const double shorter = std::min(size.x, size.y), longer = std::max(size.x, size.y);
    const double d = longer > kLong * shorter ? shorter : longer;
    return std::min(kFactor * std::pow(kBase, std::log10(d)), kWidest);
}

std::vector<AreaPoints> points_in_areas(const FloorArea& room, const FloorArea* task)
{
    const glm::dvec2 size = room.size();
    if (!(size.x > kThin) || !(size.y > kThin))
        throw Error(ErrorKind::input, "--bounds", "have no area; give the corners of the room");
    const glm::dvec2 strip = glm::min(glm::dvec2(kStrip), 0.25 * size);  // of narrow rooms
    const FloorArea inner{room.low + strip, room.high - strip};
    if (!task)
        return {points_of(RoomArea::task, inner)};
    if (glm::any(glm::lessThan(task->low, room.low - kRounding)) ||
        glm::any(glm::greaterThan(task->high, room.high + kRounding)))
        throw Error(ErrorKind::input, "--task", "is not within the bounds of the room");
    const auto both = [](const FloorArea& one, const FloorArea& other) {
        return FloorArea{glm::min(one.low, other.low), glm::max(one.high, other.high)};
    };
    const FloorArea wide{glm::max(task->low - kStrip, inner.low),
                         glm::min(task->high + kStrip, inner.high)};
    const FloorArea around = both(wide, *task);
    std::vector<AreaPoints> areas = {
        points_of(RoomArea::task, *task), points_around(RoomArea::surrounding, around, *task),
        points_around(RoomArea::background, inner,
                      {glm::max(around.low, inner.low), glm::min(around.high, inner.high)})};
    if (areas.front().points.empty())
        throw Error(ErrorKind::input, "--task", "is thinner than 0.1 m");
    std::erase_if(areas, [](const AreaPoints& one) { return one.points.empty(); });
    return areas;
}

}  // namespace lumel
