#pragma once
// The floor of a room, among all that lies in a scene: slabs, ground, furniture, other storeys.

#include <optional>

#include "rays/cast/ray_scene.h"
#include "results/measure/work_places.h"

namespace lumel {

struct RoomFloor {
    double height = 0.0;  ///< y [m]
    FloorArea area;       ///< bounds of what has this floor, to a hundredth of its size; all that
                          ///< was searched if it is smaller than a room, as below a pendant lamp
};

/// The floor within an area [m], both in the world of the rays: where most vertical lines end in
/// the lowest space of at least 1.5 m between two surfaces. Empty if there is none, as without a
/// ceiling.
std::optional<RoomFloor> floor_of_room(const RayScene& rays, const FloorArea& area);

}  // namespace lumel
