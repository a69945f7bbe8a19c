#pragma once
// Cells of lumels, and sub-lumels of mutually visible cells.
//
// One radiosity per lumel leaks light through walls. A lumel half in the sun spreads its mean to
// both sides of the shadow's edge, and one that passes under a wall spreads light from room to
// room. So each lumel has a grid of cells, and cells whose points see each other form a sub-lumel
// with its own irradiance. Points that see no cell, as in a sliver behind a wall's foot, form one
// that receives light but sends none: rays that hit it are reflected.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/near/world_lumels.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

class Ranks;

/// Cells per side of a lumel, and per lumel.
inline constexpr int kCellSide = 4, kCells = kCellSide * kCellSide;
/// Maximum sub-lumels of a lumel that have cells; the last one takes the rest.
inline constexpr std::uint32_t kMaxWithCells = 4;
/// Maximum sub-lumels of a lumel, with that of its hidden points.
inline constexpr std::uint32_t kMaxParts = kMaxWithCells + 1;

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
    /// The cell whose point is nearest to a position [m].
    std::uint32_t nearest(const glm::vec3& position) const;
};
CellPoints cell_points(const WorldLumels& world, const Cells& cells, std::size_t i);

/// No cell: of a point that sees none.
inline constexpr std::uint32_t kNoCell = kCells;

/// The cells that points of a lumel see, by rays just above it.
class SeenCells {
public:
    /// Arguments must outlive this. seed: of rays through blended surfaces.
    SeenCells(const WorldLumels& world, const Cells& cells, const RayScene& rays, std::size_t i,
              std::uint32_t seed);

    const CellPoints& points() const { return points_; }
    bool sees(const LumelPoint& from, std::uint32_t cell) const;
    RaySpan ray_to(const LumelPoint& from, std::uint32_t cell) const;
    /// The nearest one, or kNoCell.
    std::uint32_t nearest(const LumelPoint& from) const;

private:
    bool sees_over(const LumelPoint& from, std::uint32_t cell) const;

    const RayScene& rays_;
    CellPoints points_;
    bool flat_;
    glm::vec3 up_;      ///< unit
    float top_;         ///< height along it above the whole lumel, unless it is flat [m]
    float ray_offset_;  ///< [m]
    std::uint32_t seed_;
};

/// The sub-lumels of all lumels.
class SubLumels {
public:
    /// Joins cells whose points see each other by rays just above the lumel. Buried lumels stay
    /// whole. All arguments must outlive this but order [N]: in which lumels get their sub-lumels'
    /// numbers, so that those of neighbours are close in memory. ranks: that share the work, or
    /// null.
    SubLumels(const WorldLumels& world, const Cells& cells, const RayScene& rays,
              const Lumels& lumels, const std::vector<std::uint32_t>& order, std::uint32_t seed,
              Ranks* ranks = nullptr);

    /// Memory for these numbers of lumels and sub-lumels [bytes].
    static std::uint64_t bytes(std::size_t lumels, std::size_t parts)
    {
        return lumels * (2 * sizeof(std::uint32_t) + 2 * sizeof(std::uint8_t)) +
               parts * sizeof(std::uint32_t);
    }

    std::size_t count() const { return lumel_.size(); }  ///< P, the total number of sub-lumels
    std::uint32_t first(std::size_t lumel) const { return first_[lumel]; }
    std::uint32_t end(std::size_t lumel) const
    {
        return first_[lumel] + with_cells_[lumel] + (has_hidden(lumel) ? 1 : 0);
    }
    /// Number of its sub-lumels that have cells.
    std::uint32_t with_cells(std::size_t lumel) const { return with_cells_[lumel]; }
    bool is_cut(std::size_t lumel) const { return with_cells_[lumel] > 1; }
    /// True if some of its points do not see their own cell: if it is cut, or a sliver of it is
    /// behind other geometry. The last sub-lumel is that of points that see no cell.
    bool has_hidden(std::size_t lumel) const { return (flags_[lumel] & kHasHidden) != 0; }
    /// True if geometry closer than the lumel's size covers some of it, but not all: light can
    /// change there more than cells tell, as where a lamp hangs just below a ceiling.
    bool is_half_covered(std::size_t lumel) const { return (flags_[lumel] & kHalfCovered) != 0; }
    /// True for either: light at a hit is not just that of its cell.
    bool is_detailed(std::size_t lumel) const { return flags_[lumel] != 0; }
    /// Of a lumel with hidden points.
    SeenCells seen_cells(std::size_t lumel) const;
    /// The sub-lumel of a cell, or of kNoCell.
    std::uint32_t part(std::size_t lumel, std::uint32_t cell) const
    {
        return cell == kNoCell ? end(lumel) - 1 : first_[lumel] + (code_[lumel] >> 2 * cell & 3u);
    }
    std::uint32_t lumel(std::size_t part) const { return lumel_[part]; }

private:
    static constexpr std::uint8_t kHasHidden = 1, kHalfCovered = 2;

    std::uint32_t seed_of(std::size_t lumel) const;

    const WorldLumels& world_;
    const Cells& cells_;
    const RayScene& rays_;
    const Lumels& lumels_;
    std::uint32_t seed_;
    std::vector<std::uint32_t> first_;      ///< [N]
    std::vector<std::uint8_t> flags_;       ///< [N]
    std::vector<std::uint8_t> with_cells_;  ///< [N] number of sub-lumels
    std::vector<std::uint32_t> code_;       ///< [N] two bits per cell
    std::vector<std::uint32_t> lumel_;      ///< [P]
};

}  // namespace lumel
