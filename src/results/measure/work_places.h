#pragma once
// Requirements on the lighting of work places.
//
// [EN12464] EN 12464-1:2021. Light and lighting - Lighting of work places - Part 1: Indoor work
//           places. European Committee for Standardization.

#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "results/measure/work_plane.h"

namespace lumel {

/// A use of rooms [EN12464, tables of requirements].
struct RoomUse {
    const char* name;    ///< as in --en12464
    const char* title;   ///< what is done there
    double illuminance;  ///< maintained, of the task area [lx]
    double uniformity;   ///< of the task area: least / mean
    double height;       ///< of the task area above the floor [m]
};

std::span<const RoomUse> room_uses();

/// "office, conference, …"
std::string names_of_room_uses();

/// Throws Error{input} with all names.
const RoomUse& room_use_named(const std::string& name);

/// Parts of a room that have requirements of their own.
enum class RoomArea { task, surrounding, background };

/// Minimum of an area.
struct AreaLimits {
    double illuminance = 0.0;  ///< maintained [lx]
    double uniformity = 0.0;   ///< least / mean
};

/// Minimum for the band of kSurroundingWidth around a task, and for the rest of the room, by the
/// illuminance of the task [lx].
AreaLimits surrounding_limits(double task);
AreaLimits background_limits(double task);

/// Width of the immediate surrounding area, and of the strip along walls that a task area need not
/// have [m].
inline constexpr double kSurroundingWidth = 0.5;

/// x and z of two corners [m].
struct FloorArea {
    glm::dvec2 low{0.0}, high{0.0};

    bool contains(const glm::dvec2& at) const
    {
        return glm::all(glm::greaterThanEqual(at, low)) && glm::all(glm::lessThanEqual(at, high));
    }
};

/// Largest distance between points of measurement in an area: 0.2 · 5^log10(d) with d the longer
/// side, or the shorter one where that is less than half as long; at most 10 m.
double grid_spacing(const FloorArea& area);

/// Points in the areas of a room.
struct AreaPoints {
    RoomArea area = RoomArea::task;
    glm::dvec2 cell{0.0};            ///< x and z size of the cell around each point [m]
    std::vector<glm::dvec3> places;  ///< [m]
};

/// Points of all areas at a height: of the task, or without one of the room but for the strip along
/// its walls; around a task, of its surroundings and of the rest. Areas without points are left
/// out. Throws Error{input} if the task is not in the room, and for more than kMaxPlanePoints.
std::vector<AreaPoints> points_in_areas(const FloorArea& room, const FloorArea* task,
                                        double height);

}  // namespace lumel
