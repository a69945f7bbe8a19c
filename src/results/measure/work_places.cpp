#include "results/measure/work_places.h"

#include <algorithm>
#include <array>
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
    {"assembly-rough", "assembly work: rough", 200, 0.6, kDesk},
    {"assembly-medium", "assembly work: medium", 300, 0.6, kDesk},
    {"assembly-fine", "assembly work: fine", 500, 0.6, kDesk},
    {"assembly-precision", "assembly work: precision", 750, 0.7, kDesk},
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

FloorArea widened(const FloorArea& area, double by, const FloorArea& within)
{
    return {glm::max(area.low - by, within.low), glm::min(area.high + by, within.high)};
}

AreaPoints points_of(RoomArea kind, const FloorArea& outer, const FloorArea* hole, double height)
{
    const glm::dvec2 size = outer.high - outer.low;
    const glm::dvec2 counts = glm::max(glm::ceil(size / grid_spacing(outer)), 1.0);
    if (counts.x * counts.y > kMaxPlanePoints)
        throw Error(ErrorKind::input, "--bounds",
                    "make more than a million points; give the corners of one room");
    AreaPoints points{.area = kind, .cell = size / counts};
    for (double row = 0.5; row < counts.y; ++row)
        for (double column = 0.5; column < counts.x; ++column) {
            const glm::dvec2 at = outer.low + points.cell * glm::dvec2(column, row);
            if (!hole || !hole->contains(at))
                points.places.emplace_back(at.x, height, at.y);
        }
    return points;
}

}  // namespace

std::span<const RoomUse> room_uses()
{
    return kUses;
}

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
    const glm::dvec2 size = area.high - area.low;
    const double shorter = std::min(size.x, size.y), longer = std::max(size.x, size.y);
    const double d = longer > kLong * shorter ? shorter : longer;
    return std::min(kFactor * std::pow(kBase, std::log10(d)), kWidest);
}

std::vector<AreaPoints> points_in_areas(const FloorArea& room, const FloorArea* task, double height)
{
    std::vector<AreaPoints> areas;
    if (!task) {
        const glm::dvec2 strip = glm::min(glm::dvec2(kSurroundingWidth),
                                          0.25 * (room.high - room.low));  // of narrow rooms
        areas.push_back(
            points_of(RoomArea::task, {room.low + strip, room.high - strip}, nullptr, height));
    } else {
        if (!room.contains(task->low) || !room.contains(task->high))
            throw Error(ErrorKind::input, "--task", "is not within the bounds of the room");
        const FloorArea around = widened(*task, kSurroundingWidth, room);
        areas.push_back(points_of(RoomArea::task, *task, nullptr, height));
        areas.push_back(points_of(RoomArea::surrounding, around, task, height));
        areas.push_back(points_of(RoomArea::background, room, &around, height));
    }
    std::erase_if(areas, [](const AreaPoints& one) { return one.places.empty(); });
    return areas;
}

}  // namespace lumel
