#pragma once
// Lumels cut into cells, and cells joined into parts.
//
// One radiosity per lumel hands light through walls: a lumel that lies half in the sun gives its
// mean to both sides of its shadow's edge, and one that passes under a wall gives that of one room
// to the other. So each lumel has a grid of cells, and those whose points see each other make up
// a part. Every part has its own irradiance.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/near/world_lumels.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// Cells along each side of a lumel, and in all.
inline constexpr int kCellSide = 4, kCells = kCellSide * kCellSide;
/// Most parts of a lumel; what would be more joins the last.
inline constexpr std::uint32_t kMaxParts = 4;

/// The grid of cells over each lumel: the box around its pieces in their plane.
class Cells {
public:
    explicit Cells(const WorldLumels& world);

    static std::uint64_t bytes(std::size_t lumels) { return lumels * sizeof(Grid); }

    /// The cell of lumel i that holds a point [m], or the nearest to it: 0…kCells - 1.
    std::uint32_t cell(std::size_t i, const glm::vec3& position) const
    {
        const Grid& grid = grids_[i];
        const int x = std::clamp(int(glm::dot(grid.x, position) + grid.x0), 0, kCellSide - 1);
        const int y = std::clamp(int(glm::dot(grid.y, position) + grid.y0), 0, kCellSide - 1);
        return std::uint32_t(y * kCellSide + x);
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

/// A point for each cell of a lumel that has one.
struct CellPoints {
    std::array<LumelPoint, kCells> point;
    std::uint32_t used = 0;  ///< bit c: cell c has a point

    bool has(std::uint32_t cell) const { return (used >> cell & 1u) != 0; }
};
CellPoints cell_points(const WorldLumels& world, const Cells& cells, std::size_t i);

/// Which part a cell belongs to.
class SubLumels {
public:
    /// Joins cells whose points see each other by rays lifted off the lumel. Buried lumels are not
    /// cut.
    SubLumels(const WorldLumels& world, const Cells& cells, const RayScene& rays,
              const std::vector<char>& buried, std::uint32_t seed);

    /// Of lumels with as many parts.
    static std::uint64_t bytes(std::size_t lumels, std::size_t parts)
    {
        return 2 * lumels * sizeof(std::uint32_t) + parts * sizeof(std::uint32_t);
    }

    std::size_t count() const { return lumel_.size(); }  ///< P, of all lumels together
    std::uint32_t first(std::size_t lumel) const { return first_[lumel]; }
    std::uint32_t end(std::size_t lumel) const { return first_[lumel + 1]; }
    bool is_cut(std::size_t lumel) const { return end(lumel) > first(lumel) + 1; }
    /// The part of a lumel that holds one of its cells.
    std::uint32_t part(std::size_t lumel, std::uint32_t cell) const
    {
        return first_[lumel] + (code_[lumel] >> 2 * cell & 3u);
    }
    std::uint32_t lumel(std::size_t part) const { return lumel_[part]; }

private:
    std::vector<std::uint32_t> first_;  ///< [N + 1]
    std::vector<std::uint32_t> code_;   ///< [N] two bits for each cell
    std::vector<std::uint32_t> lumel_;  ///< [P]
};

}  // namespace lumel
