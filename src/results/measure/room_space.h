#pragma once
// The space of a room at the height of its work plane.

#include <array>

#include "rays/cast/ray_scene.h"
#include "results/measure/work_places.h"

namespace lumel {

/// The part of an area that no surface divides at a height: without what lies behind walls, such as
/// the notch of an L-shaped plan, and without the inside of furniture.
class RoomSpace {
public:
    /// Takes the part that has most of `core`. All in the coordinates of the rays [m].
    RoomSpace(const RayScene& rays, const FloorArea& area, const FloorArea& core, double height);

    /// True for points in that part, or within a 64th of the area's sides from it.
    bool has(const glm::dvec2& at) const;

private:
    static constexpr int kSide = 64;  ///< cells along a side

    static std::size_t index(int x, int z) { return std::size_t(z * kSide + x); }
    glm::vec3 middle(int x, int z) const;
    std::size_t fill(const RayScene& rays, const FloorArea& core, int x, int z);

    FloorArea area_;
    double height_;
    std::array<int, std::size_t(kSide) * kSide> part_{};  ///< number of the cell's part, from 1 on
    int parts_ = 0, chosen_ = 1;
};

}  // namespace lumel
