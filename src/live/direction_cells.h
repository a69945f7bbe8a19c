#pragma once
// Cells of a grid over the directions of a hemisphere.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/glm.hpp>

namespace lumel {

/// A rectangle of cells (u, v) of a grid of side × side over (sin² θ, φ / 2π). v counts around.
struct DirectionCells {
    std::uint32_t first_u = 0, end_u = 0;
    std::uint32_t first_v = 0, count_v = 0;

    /// visit(cell), numbered v * side + u.
    template <class Visit>
    void for_each(std::uint32_t side, const Visit& visit) const
    {
        for (std::uint32_t n = 0; n < count_v; ++n)
            for (std::uint32_t u = first_u; u < end_u; ++u)
                visit((first_v + n) % side * side + u);
    }
};

/// Those that hold all directions from 0 that meet a ball and lie above the horizon z = 0.
/// centre [m]: in the frame of the hemisphere. radius [m].
inline DirectionCells cells_towards(const glm::vec3& centre, float radius, std::uint32_t side)
{
    // Far above the rounding of angles and squares of sines, far below a cell.
    constexpr float kRounding = 1e-4f, kPi = std::numbers::pi_v<float>;
    const float distance = glm::length(centre);
    if (centre.z + radius < 0.0f)
        return {};
    if (distance <= radius)
        return {0, side, 0, side};
    const float half = std::asin(radius / distance) + kRounding;
    const float theta = std::acos(std::clamp(centre.z / distance, -1.0f, 1.0f));
    const auto cell = [&](float at) { return std::floor(at * float(side)); };
    const auto sine2 = [](float angle) { return std::sin(angle) * std::sin(angle); };
    const float low = sine2(std::clamp(theta - half, 0.0f, 0.5f * kPi)) - kRounding;
    const float high = sine2(std::clamp(theta + half, 0.0f, 0.5f * kPi)) + kRounding;
    DirectionCells cells{std::uint32_t(std::max(cell(low), 0.0f)),
                         std::min(std::uint32_t(cell(high)) + 1, side), 0, side};
    if (theta <= half || theta + half >= kPi)
        return cells;  // a pole is inside
    const float turn =
        std::asin(std::min(std::sin(half) / std::sin(theta), 1.0f)) / (2.0f * kPi) + kRounding;
    const float around = std::atan2(centre.y, centre.x) / (2.0f * kPi);
    const float first = cell(around - turn), last = cell(around + turn);
    if (last - first + 1.0f >= float(side))
        return cells;
    cells.first_v = std::uint32_t(int(first) + 2 * int(side)) % side;
    cells.count_v = std::uint32_t(last - first) + 1;
    return cells;
}

}  // namespace lumel
