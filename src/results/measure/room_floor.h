#pragma once
// The floor of a room, among all that lies in a scene: slabs, ground, furniture, other storeys.

#include <optional>

#include "rays/cast/ray_scene.h"
#include "results/measure/work_places.h"

namespace lumel {

/// Sides that four horizontal rays from a point hit.
struct SidesAround {
    int fronts = 0, backs = 0;
};
SidesAround sides_around(const RayScene& rays, const glm::vec3& point);

struct RoomFloor {
    double height = 0.0;  ///< y [m]
    FloorArea area;       ///< bounds of the floor, to 1 % of its size; the whole search area if the
                          ///< floor is smaller than a room, as below a pendant lamp
};

/// The floor within an area [m], both in the coordinates of the rays: the most common lower end of
/// the lowest gap of at least 1.5 m along vertical lines. Empty if there is none, as without a
/// ceiling.
std::optional<RoomFloor> floor_of_room(const RayScene& rays, const FloorArea& area);

}  // namespace lumel
