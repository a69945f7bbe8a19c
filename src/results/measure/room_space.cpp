#include "results/measure/room_space.h"

#include <algorithm>

#include "results/measure/room_floor.h"

namespace lumel {
RoomSpace::RoomSpace(const RayScene& rays, const FloorArea& area, double height,
                     const std::optional<FloorArea>& task)
    : rays_(rays),
      area_(area),
      height_(height)
{
    int number = 0;
    std::ptrdiff_t most = 0;
    for (int z = 0; z < kSide; ++z)
        for (int x = 0; x < kSide; ++x) {
            if (part({x, z}) != 0)
                continue;
            const std::vector<Cell> cells = fill({x, z}, ++number);
            const std::ptrdiff_t count = std::ranges::count_if(cells, [&](const Cell& cell) {
                return task ? is_in(cell, *task) : is_enclosed(cell);
            });
            if (count > most) {
                most = count;
                chosen_ = number;
            }
        }
}

bool RoomSpace::exists(const Cell& cell)
{
    return cell.x >= 0 && cell.z >= 0 && cell.x < kSide && cell.z < kSide;
}

glm::dvec2 RoomSpace::corner(int x, int z) const
{
    return area_.low + (area_.high - area_.low) * glm::dvec2(x, z) / double(kSide);
}

glm::vec3 RoomSpace::middle(const Cell& cell) const
{
    const glm::dvec2 at = 0.5 * (corner(cell.x, cell.z) + corner(cell.x + 1, cell.z + 1));
    return {at.x, height_, at.y};
}

bool RoomSpace::is_free(const glm::vec3& from, const glm::vec3& to) const
{
    const RaySpan way = ray_between(from, to, 0.0f, 0);
    RayHit hit;
    return way.far <= way.near || !rays_.closest(way, hit);
}

bool RoomSpace::is_in(const Cell& cell, const FloorArea& task) const
{
    const glm::dvec2 low = corner(cell.x, cell.z), high = corner(cell.x + 1, cell.z + 1);
    return high.x >= task.low.x && high.y >= task.low.y && low.x <= task.high.x &&
           low.y <= task.high.y;
}

/// True if fronts stand on at least three sides of a cell: not outdoors, nor inside of a solid.
bool RoomSpace::is_enclosed(const Cell& cell) const
{
    constexpr int kLeastFronts = 3;
    return sides_around(rays_, middle(cell)).fronts >= kLeastFronts;
}

/// Numbers the cells that join a cell, and returns them.
std::vector<RoomSpace::Cell> RoomSpace::fill(const Cell& first, int number)
{
    std::vector<Cell> cells = {first};
    part(first) = number;
    for (std::size_t n = 0; n < cells.size(); ++n) {
        const Cell from = cells[n];
        for (const Cell& to : {Cell{from.x + 1, from.z}, Cell{from.x - 1, from.z},
                               Cell{from.x, from.z + 1}, Cell{from.x, from.z - 1}}) {
            if (!exists(to) || part(to) != 0 || !is_free(middle(from), middle(to)))
                continue;
            part(to) = number;
            cells.push_back(to);
        }
    }
    return cells;
}

bool RoomSpace::has(const glm::dvec2& at) const
{
    if (chosen_ == 0)
        return true;
    const glm::dvec2 place = double(kSide) * (at - area_.low) / (area_.high - area_.low);
    const glm::ivec2 own(glm::floor(place));
    const glm::vec3 point(at.x, height_, at.y);
    // The middle of the own cell can lie inside furniture.
    for (int z = own.y - 1; z <= own.y + 1; ++z)
        for (int x = own.x - 1; x <= own.x + 1; ++x)
            if (const Cell cell{x, z};
                exists(cell) && part(cell) == chosen_ && is_free(point, middle(cell)))
                return true;
    return false;
}

}  // namespace lumel
