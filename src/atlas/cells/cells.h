#pragma once
// Cells of lumels, and sub-lumels of mutually visible cells.
//
// One radiosity per lumel leaks light through walls. A lumel half in the sun spreads its mean to
// both sides of the shadow's edge, and one that passes under a wall spreads light from room to
// room. So each lumel has a grid of cells, and cells whose points see each other form a sub-lumel
// with its own irradiance.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/near/world_lumels.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// Cells per side of a lumel, and per lumel.
inline constexpr int kCellSide = 4, kCells = kCellSide * kCellSide;
/// Maximum sub-lumels of a lumel; the last one takes the rest.
inline constexpr std::uint32_t kMaxParts = 4;

/// The grid of cells of each lumel: a bounding box of its pieces in their plane.
class Cells {
public:
    explicit Cells(const WorldLumels& world);

    static std::uint64_t bytes(std::size_t lumels) { return lumels * sizeof(Grid); }

    /// Index of the cell of lumel i nearest to a point [m]: 0…kCells - 1.
    std::uint32_t cell(std::size_t i, const glm::vec3& position) const
    {
        const Grid& grid = grids_[i];
        const int x = std::clamp(int(glm::dot(grid.x, position) + grid.x0), 0, kCellSide - 1);
        const int y = std::clamp(int(glm::dot(grid.y, position) + grid.y0), 0, kCellSide - 1);
        return std::uint32_t(y * kCellSide + x);
    }

    /// Centre of a cell in the plane of lumel i through a point [m].
    glm::vec3 centre(std::size_t i, const glm::vec3& point, std::uint32_t cell) const
    {
        const Grid& grid = grids_[i];
        const float x = float(cell % kCellSide) + 0.5f - grid.x0 - glm::dot(grid.x, point);
        const std::uint32_t row = cell / kCellSide;
        const float y = float(row) + 0.5f - grid.y0 - glm::dot(grid.y, point);
        return point + grid.x * (x / glm::dot(grid.x, grid.x)) +
               grid.y * (y / glm::dot(grid.y, grid.y));
    }

private:
    /// dot(x, position) + x0 counts cells along the first side.
    struct Grid {
        glm::vec3 x;
        float x0;
        glm::vec3 y;
        float y0;
    };
    std::vector<Grid> grids_;  ///< [N]
};

/// A point for each cell that has one.
struct CellPoints {
    std::array<LumelPoint, kCells> point;
    std::uint32_t used = 0;  ///< bit c: cell c has a point

    bool has(std::uint32_t cell) const { return (used >> cell & 1u) != 0; }
};
CellPoints cell_points(const WorldLumels& world, const Cells& cells, std::size_t i);

/// The sub-lumels of all lumels.
class SubLumels {
public:
    /// Joins cells whose points see each other by rays just above the lumel. Buried lumels stay
    /// whole. order [N]: in which lumels get their sub-lumels' numbers, so that those of neighbours
    /// are close in memory.
    SubLumels(const WorldLumels& world, const Cells& cells, const RayScene& rays,
              const Lumels& lumels, const std::vector<std::uint32_t>& order, std::uint32_t seed);

    /// Memory for these numbers of lumels and sub-lumels [bytes].
    static std::uint64_t bytes(std::size_t lumels, std::size_t parts)
    {
        return lumels * (2 * sizeof(std::uint32_t) + sizeof(std::uint8_t)) +
               parts * sizeof(std::uint32_t);
    }

    std::size_t count() const { return lumel_.size(); }  ///< P, the total number of sub-lumels
    std::uint32_t first(std::size_t lumel) const { return first_[lumel]; }
    std::uint32_t end(std::size_t lumel) const { return first_[lumel] + parts_[lumel]; }
    bool is_cut(std::size_t lumel) const { return parts_[lumel] > 1; }
    /// The sub-lumel of a cell.
    std::uint32_t part(std::size_t lumel, std::uint32_t cell) const
    {
        return first_[lumel] + (code_[lumel] >> 2 * cell & 3u);
    }
    std::uint32_t lumel(std::size_t part) const { return lumel_[part]; }

private:
    std::vector<std::uint32_t> first_;  ///< [N]
    std::vector<std::uint8_t> parts_;   ///< [N] number of sub-lumels
    std::vector<std::uint32_t> code_;   ///< [N] two bits per cell
    std::vector<std::uint32_t> lumel_;  ///< [P]
};

}  // namespace lumel
