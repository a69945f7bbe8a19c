#pragma once
// Grid cells over the directions of a hemisphere.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/glm.hpp>

namespace lumel {

/// Rectangle of cells (u, v) of a side × side grid over (sin² θ, φ / 2π). v is periodic.
struct DirectionCells {
    std::uint32_t first_u = 0, end_u = 0;
    std::uint32_t first_v = 0, count_v = 0;

    /// Calls visit(cell), numbered v * side + u.
    template <class Visit>
    void for_each(std::uint32_t side, const Visit& visit) const
    {
        for (std::uint32_t n = 0; n < count_v; ++n)
            for (std::uint32_t u = first_u; u < end_u; ++u)
                visit((first_v + n) % side * side + u);
    }
};

/// Cells with all directions from 0 that meet a box, centre ± half[0] ± half[1] ± half[2] [m],
/// above the horizon z = 0. Seen from outside, the corners bound a box in azimuth and from below;
/// its height and its distance from the axis bound it from above.
inline DirectionCells cells_towards(const glm::vec3& centre, const glm::mat3& half,
                                    std::uint32_t side)
{
    // Well above the rounding of angles and squared sines, well below a cell.
    constexpr float kRounding = 1e-4f, kPi = std::numbers::pi_v<float>;
    if (centre.z + std::abs(half[0].z) + std::abs(half[1].z) + std::abs(half[2].z) < 0.0f)
        return {};
    const float away = glm::length(glm::vec2(centre));
    const glm::vec2 along = away > 0.0f ? glm::vec2(centre) / away : glm::vec2(0.0f);
    const auto turn = [](const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; };
    float lowest = centre.z, highest = centre.z, nearest = away, high = 0.0f;
    glm::vec2 right = along, left = along;
    for (int k = 0; k < 8; ++k) {
        const glm::vec3 corner = centre + ((k & 1) != 0 ? half[0] : -half[0]) +
                                 ((k & 2) != 0 ? half[1] : -half[1]) +
                                 ((k & 4) != 0 ? half[2] : -half[2]);
        const glm::vec2 aside(corner);
        lowest = std::min(lowest, corner.z);
        highest = std::max(highest, corner.z);
        nearest = std::min(nearest, glm::dot(aside, along));
        high = std::max(high, glm::dot(aside, aside) / glm::dot(corner, corner));
        right = turn(right, aside) < 0.0f ? aside : right;
        left = turn(left, aside) > 0.0f ? aside : left;
    }
    const bool around = !(nearest > 0.0f);  // the box may contain the axis
    const float low = around ? 0.0f : nearest * nearest / (nearest * nearest + highest * highest);
    if (!(lowest > 0.0f))
        high = 1.0f;
    const auto cell = [&](float at) { return std::floor(at * float(side)); };
    DirectionCells cells{std::uint32_t(std::max(cell(low - kRounding), 0.0f)),
                         std::min(std::uint32_t(cell(high + kRounding)) + 1, side), 0, side};
    if (around)
        return cells;
    const auto angle = [](const glm::vec2& at) { return std::atan2(at.y, at.x) / (2.0f * kPi); };
    const float from = angle(right), to = angle(left);
    const float first = cell(from - kRounding),
                last = cell((to < from ? to + 1.0f : to) + kRounding);
    if (last - first + 1.0f >= float(side))
        return cells;
    cells.first_v = std::uint32_t(int(first) + 2 * int(side)) % side;
    cells.count_v = std::uint32_t(last - first) + 1;
    return cells;
}

}  // namespace lumel
