#pragma once
// Requirements on the lighting of work places.
//
// [EN12464] EN 12464-1:2021. Light and lighting - Lighting of work places - Part 1: Indoor work
//           places. European Committee for Standardization.

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// A use of rooms [EN12464, tables of requirements].
struct RoomUse {
    const char* name;    ///< as in --en12464
    const char* title;   ///< what is done there
    double illuminance;  ///< maintained, of the task area [lx]
    double uniformity;   ///< of the task area: least / mean
    double height;       ///< of the task area above the floor [m]
};

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

/// Minimum for the immediate surrounding area, and for the rest of the room, by the illuminance of
/// the task [lx].
AreaLimits surrounding_limits(double task);
AreaLimits background_limits(double task);

/// x and z of two corners [m].
struct FloorArea {
    glm::dvec2 low{0.0}, high{0.0};

    glm::dvec2 size() const { return high - low; }
};

/// Largest distance between points of measurement in an area: 0.2 · 5^log10(d) with d the longer
/// side, or the shorter one where that is less than half as long; at most 10 m.
double grid_spacing(const FloorArea& area);

/// A point of measurement in the middle of its cell.
struct AreaPoint {
    glm::dvec2 at;    ///< x and z [m]
    glm::dvec2 cell;  ///< its size [m]
};

/// Points of an area, whose cells fill it; none: the room has no such area.
struct AreaPoints {
    RoomArea area = RoomArea::task;
    double spacing = 0.0;  ///< maximum [m]
    std::vector<AreaPoint> points;
};

/// Maximum number of points in a room.
inline constexpr double kMaxRoomPoints = 10000.0;

/// Points of a room without a strip of 0.5 m along its walls: of a task, which may reach the walls,
/// of the band of 0.5 m around it, and of the rest; without a task, of all as the task area. Throws
/// Error{input} if the room has no area, for a task that is not in it, and for more than
/// kMaxRoomPoints.
std::vector<AreaPoints> points_in_areas(const FloorArea& room, const FloorArea* task);

}  // namespace lumel
