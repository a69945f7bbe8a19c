#include "results/measure/room_space.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace lumel {

RoomSpace::RoomSpace(const RayScene& rays, const FloorArea& area, const FloorArea& core,
                     double height)
    : area_(area),
      height_(height)
{
    std::size_t most = 0;
    for (int z = 0; z < kSide; ++z)
        for (int x = 0; x < kSide; ++x)
            if (part_[index(x, z)] == 0) {
                const std::size_t cells = fill(rays, core, x, z);
                if (cells > most) {
                    most = cells;
                    chosen_ = parts_;
                }
            }
}

glm::vec3 RoomSpace::middle(int x, int z) const
{
    const glm::dvec2 at =
        area_.low + (area_.high - area_.low) * (glm::dvec2(x, z) + 0.5) / double(kSide);
    return {at.x, height_, at.y};
}

/// Numbers the cells that join a cell. Returns how many of them are in `core`.
std::size_t RoomSpace::fill(const RayScene& rays, const FloorArea& core, int first_x, int first_z)
{
    const int number = ++parts_;
    std::vector<std::pair<int, int>> cells = {{first_x, first_z}};
    part_[index(first_x, first_z)] = number;
    for (std::size_t n = 0; n < cells.size(); ++n) {
        const auto [x, z] = cells[n];
        for (const auto& [dx, dz] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
            const int to_x = x + dx, to_z = z + dz;
            if (to_x < 0 || to_z < 0 || to_x >= kSide || to_z >= kSide ||
                part_[index(to_x, to_z)] != 0)
                continue;
            const glm::vec3 from = middle(x, z), way = middle(to_x, to_z) - from;
            const float length = glm::length(way);
            RayHit hit;
            if (length > 0.0f && rays.closest(from, way / length, 0.0f, length, 0, hit))
                continue;
            part_[index(to_x, to_z)] = number;
            cells.emplace_back(to_x, to_z);
        }
    }
    return std::size_t(std::ranges::count_if(cells, [&](const std::pair<int, int>& cell) {
        const glm::vec3 at = middle(cell.first, cell.second);
        return at.x >= float(core.low.x) && at.x <= float(core.high.x) &&
               at.z >= float(core.low.y) && at.z <= float(core.high.y);
    }));
}

bool RoomSpace::has(const glm::dvec2& at) const
{
    const glm::dvec2 cell = double(kSide) * (at - area_.low) / (area_.high - area_.low);
    const glm::ivec2 own(glm::floor(cell));
    for (int z = std::max(own.y - 1, 0); z <= std::min(own.y + 1, kSide - 1); ++z)
        for (int x = std::max(own.x - 1, 0); x <= std::min(own.x + 1, kSide - 1); ++x)
            if (part_[index(x, z)] == chosen_)
                return true;
    return false;
}

}  // namespace lumel
