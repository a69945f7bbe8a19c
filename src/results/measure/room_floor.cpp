#include "results/measure/room_floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace lumel {
namespace {

constexpr int kLinesAlongSide = 64;
constexpr int kMostSurfaces = 256;     ///< that a line meets
constexpr double kRoomSide = 1.5;      ///< least width of a room [m]
constexpr float kRoomHeight = 1.5f;    ///< least height of a room [m]
constexpr double kShareOfRoom = 0.25;  ///< least part of the room's longest side at its bounds
constexpr double kSameFloor = 0.01;    ///< [m]
constexpr float kAbove = 1.0f;         ///< start of the lines above the scene [m]

/// True if two of the sides around are backs. Not all four are: adjacent solids can share a side.
bool is_in_a_solid(const RayScene& rays, const glm::vec3& point)
{
    constexpr int kLeastBacks = 2;
    return sides_around(rays, point).backs >= kLeastBacks;
}

/// Height of the floor of the lowest room along a vertical line.
std::optional<double> floor_at(const RayScene& rays, float x, float z)
{
    const glm::vec3 start(x, rays.high().y + kAbove, z), down(0.0f, -1.0f, 0.0f);
    const float far = std::numeric_limits<float>::max();
    std::optional<double> floor;
    RayHit upper, lower;
    if (!rays.closest(start, down, 0.0f, far, 0, upper))
        return floor;
    for (int k = 0; k < kMostSurfaces; ++k) {
        if (!rays.closest(start, down, upper.distance + upper.ray_offset, far, 0, lower))
            break;
        const glm::vec3 middle = start + 0.5f * (upper.distance + lower.distance) * down;
        if (lower.distance - upper.distance >= kRoomHeight && !is_in_a_solid(rays, middle))
            floor = double(start.y) - double(lower.distance);
        upper = lower;
    }
    return floor;
}

/// Index of the most common value, to kSameFloor, of ascending ones.
std::size_t most_common(const std::vector<double>& values)
{
    std::size_t best = 0, most = 0;
    for (std::size_t first = 0, last = 0; first < values.size(); ++first) {
        while (last < values.size() && values[last] - values[first] <= kSameFloor)
            ++last;
        if (last - first > most) {
            most = last - first;
            best = first + most / 2;
        }
    }
    return best;
}

/// Vertical lines through the centres of the cells of an area.
class Lines {
public:
    Lines(const RayScene& rays, const FloorArea& area)
        : area_(area),
          cell_(area.size() / double(kLinesAlongSide))
    {
        for (int i = 0; i < kLinesAlongSide; ++i)
            for (int j = 0; j < kLinesAlongSide; ++j) {
                const glm::dvec2 at = corner(i, j) + 0.5 * cell_;
                floors_.push_back(floor_at(rays, float(at.x), float(at.y)));
            }
    }

    /// The most common height of floors; empty if there is no floor.
    std::optional<double> height() const
    {
        std::vector<double> found;
        for (const std::optional<double>& floor : floors_)
            if (floor)
                found.push_back(*floor);
        if (found.empty())
            return {};
        std::sort(found.begin(), found.end());
        return found[most_common(found)];
    }

    /// Bounds of the floor at this height, without niches.
    FloorArea bounds(double height) const
    {
        std::array<int, kLinesAlongSide> columns{}, rows{};
        for (int i = 0; i < kLinesAlongSide; ++i)
            for (int j = 0; j < kLinesAlongSide; ++j) {
                const auto& floor = floors_[std::size_t(i) * kLinesAlongSide + std::size_t(j)];
                const int has = floor && std::abs(*floor - height) <= kSameFloor ? 1 : 0;
                columns[std::size_t(i)] += has;
                rows[std::size_t(j)] += has;
            }
        const auto [x0, x1] = range_of(columns);
        const auto [z0, z1] = range_of(rows);
        return {corner(x0, z0), corner(x1, z1)};
    }

    const glm::dvec2& cell() const { return cell_; }

private:
    /// First row or column with enough lines, and the one after the last.
    static std::pair<int, int> range_of(const std::array<int, kLinesAlongSide>& lines)
    {
        const double least = kShareOfRoom * *std::max_element(lines.begin(), lines.end());
        const auto enough = [&](int count) { return count >= least; };
        const auto first = std::find_if(lines.begin(), lines.end(), enough);
        const auto last = std::find_if(lines.rbegin(), lines.rend(), enough);
        return {int(first - lines.begin()), int(last.base() - lines.begin())};
    }

    glm::dvec2 corner(int i, int j) const { return area_.low + cell_ * glm::dvec2(i, j); }

    const FloorArea area_;
    const glm::dvec2 cell_;
    std::vector<std::optional<double>> floors_;
};

}  // namespace

SidesAround sides_around(const RayScene& rays, const glm::vec3& point)
{
    SidesAround sides;
    for (const glm::vec3& direction :
         {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
        RayHit hit;
        if (rays.closest(ray_out(point, direction, 0), hit))
            ++(hit.front ? sides.fronts : sides.backs);
    }
    return sides;
}

std::optional<RoomFloor> floor_of_room(const RayScene& rays, const FloorArea& area)
{
    constexpr int kFiner = 2;  // further passes, each with closer lines
    std::optional<Lines> lines(std::in_place, rays, area);
    const std::optional<double> height = lines->height();
    if (!height)
        return {};
    RoomFloor floor{*height, lines->bounds(*height)};
    for (int k = 0; k < kFiner; ++k) {
        // The floor can reach up to a cell beyond these bounds.
        const FloorArea around{glm::max(floor.area.low - lines->cell(), area.low),
                               glm::min(floor.area.high + lines->cell(), area.high)};
        lines.emplace(rays, around);
        floor.area = lines->bounds(*height);
    }
    const glm::dvec2 size = floor.area.size();
    if (std::min(size.x, size.y) < kRoomSide)
        floor.area = area;
    return floor;
}

}  // namespace lumel
