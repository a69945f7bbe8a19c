#pragma once
// The space of a room at the height of its work plane.

#include <array>
#include <optional>
#include <vector>

#include "rays/cast/ray_scene.h"
#include "results/measure/work_places.h"

namespace lumel {

/// The part of an area that no surface divides at a height: without what lies behind walls, such as
/// the notch of an L-shaped plan, and without the inside of furniture.
class RoomSpace {
public:
    /// Takes the part with most cells in `task` or, without one, with most cells that have surfaces
    /// around them; all of the area if there is none. All in the coordinates of the rays [m], which
    /// must outlive this.
    RoomSpace(const RayScene& rays, const FloorArea& area, double height,
              const std::optional<FloorArea>& task);

    /// True for points of that part.
    bool has(const glm::dvec2& at) const;

private:
    static constexpr int kSide = 64;  ///< cells along a side
    struct Cell {
        int x, z;
    };

    static bool exists(const Cell& cell);
    static std::size_t index(const Cell& cell)
    {
        return std::size_t(cell.z) * kSide + std::size_t(cell.x);
    }
    int& part(const Cell& cell) { return parts_[index(cell)]; }
    int part(const Cell& cell) const { return parts_[index(cell)]; }
    glm::dvec2 corner(int x, int z) const;
    glm::vec3 middle(const Cell& cell) const;
    bool is_free(const glm::vec3& from, const glm::vec3& to) const;
    bool is_in(const Cell& cell, const FloorArea& task) const;
    bool is_enclosed(const Cell& cell) const;
    std::vector<Cell> fill(const Cell& first, int number);

    const RayScene& rays_;
    FloorArea area_;
    double height_;
    std::array<int, std::size_t(kSide) * kSide> parts_{};  ///< number of each cell's part, from 1
    int chosen_ = 0;                                       ///< 0: all
};

}  // namespace lumel
