#include "atlas/cells/cells.h"

#include <numeric>

#include "atlas/cells/ray_origins.h"
#include "base/core/parallel.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Height of rays between cells above the surface, in sides of the lumel. Smaller heights keep gaps
/// under furniture open, larger ones pass over ledges and low steps.
constexpr float kAboveCell = 0.05f;
/// Lumels per task.
constexpr std::size_t kCellsPerTask = 256;

/// A disjoint-set forest of the cells.
class Joined {
public:
    Joined() { std::iota(above_.begin(), above_.end(), 0u); }
    std::uint32_t root(std::uint32_t cell) const
    {
        while (above_[cell] != cell)
            cell = above_[cell];
        return cell;
    }
    void join(std::uint32_t a, std::uint32_t b) { above_[root(b)] = root(a); }

private:
    std::array<std::uint32_t, kCells> above_;
};

/// Joins cells at an offset from each other whose points are mutually visible.
void join_along(const CellPoints& points, int dx, int dy, float ray_offset, const RayScene& rays,
                std::uint32_t seed, Joined& joined)
{
    for (int y = 0; y + dy < kCellSide; ++y)
        for (int x = std::max(0, -dx); x < kCellSide && x + dx < kCellSide; ++x) {
            const auto a = std::uint32_t(y * kCellSide + x);
            const auto b = std::uint32_t((y + dy) * kCellSide + x + dx);
            if (!points.has(a) || !points.has(b) || joined.root(a) == joined.root(b))
                continue;
            const LumelPoint &from = points.point[a], &to = points.point[b];
            if (rays.sees(from.position + ray_offset * from.normal,
                          to.position + ray_offset * to.normal, 0.0f, seed))
                joined.join(a, b);
        }
}

/// The nearest cell on the grid that has a point.
std::uint32_t nearest_used(const CellPoints& points, std::uint32_t cell)
{
    std::uint32_t best = cell;
    int least = 2 * kCellSide * kCellSide;
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c) {
        const int dx = int(c) % kCellSide - int(cell) % kCellSide;
        const int dy = int(c) / kCellSide - int(cell) / kCellSide;
        if (points.has(c) && dx * dx + dy * dy < least) {
            least = dx * dx + dy * dy;
            best = c;
        }
    }
    return best;
}

/// Stores two bits per cell: the number of its sub-lumel in the lumel. Returns the number of
/// sub-lumels.
std::uint32_t number_parts(const CellPoints& points, const Joined& joined, std::uint32_t& code)
{
    std::array<std::uint32_t, kCells> number{};
    std::uint32_t parts = 0;
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c)
        if (points.has(c) && joined.root(c) == c)
            number[c] = std::min(parts++, kMaxParts - 1);
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c) {
        const std::uint32_t used = points.has(c) ? c : nearest_used(points, c);
        code |= number[joined.root(used)] << 2 * c;
    }
    return std::clamp(parts, 1u, kMaxParts);
}

}  // namespace

Cells::Cells(const WorldLumels& world) : grids_(world.size())
{
    parallel_for(world.size(), kCellsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::span<const Piece> pieces = world.pieces(world[i]);
            const glm::vec3 x = glm::normalize(pieces[0].edge_u);
            const glm::vec3 y = glm::normalize(glm::cross(world[i].normal, x));
            glm::vec2 low(std::numeric_limits<float>::max()), high(-low);
            for (auto facet = world.begin(world[i]); facet != world.end(world[i]); ++facet)
                for (int k = 0; k < facet->count; ++k) {
                    const glm::vec3 p = facet->corner[k] - world[i].centre;
                    const glm::vec2 at(glm::dot(x, p), glm::dot(y, p));
                    low = glm::min(low, at);
                    high = glm::max(high, at);
                }
            const glm::vec2 scale =
                float(kCellSide) / glm::max(high - low, glm::vec2(1e-6f * world[i].size));
            const glm::vec2 centre(glm::dot(x, world[i].centre), glm::dot(y, world[i].centre));
            grids_[i] = {.x = scale.x * x,
                         .x0 = -scale.x * (centre.x + low.x),
                         .y = scale.y * y,
                         .y0 = -scale.y * (centre.y + low.y)};
        }
    });
}

CellPoints cell_points(const WorldLumels& world, const Cells& cells, std::size_t i)
{
    CellPoints points;
    for (int y = 0; y < kCellSide; ++y)
        for (int x = 0; x < kCellSide; ++x) {
            const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / float(kCellSide);
            const LumelPoint point = world.point_on(i, at);
            const std::uint32_t cell = cells.cell(i, point.position);
            if (!points.has(cell)) {
                points.point[cell] = point;
                points.used |= 1u << cell;
            }
        }
    return points;
}

SubLumels::SubLumels(const WorldLumels& world, const Cells& cells, const RayScene& rays,
                     const Lumels& lumels, const std::vector<std::uint32_t>& order,
                     std::uint32_t seed)
    : first_(world.size(), 0),
      parts_(world.size(), 1),
      code_(world.size(), 0)
{
    parallel_for(world.size(), kCellsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (lumels.lumels[i].flags & kLumelBuried)
                continue;
            const CellPoints points = cell_points(world, cells, i);
            const float ray_offset =
                std::max(kAboveCell * world[i].size, ray_offset_for(world[i].reach));
            const std::uint32_t own =
                PathSamples::hash(seed, lumel_key(lumels.lumels[i], std::uint32_t(lumels.width)));
            Joined joined;
            join_along(points, 1, 0, ray_offset, rays, own, joined);
            join_along(points, 0, 1, ray_offset, rays, own, joined);
            join_along(points, 1, 1, ray_offset, rays, own, joined);
            join_along(points, -1, 1, ray_offset, rays, own, joined);
            parts_[i] = std::uint8_t(number_parts(points, joined, code_[i]));
        }
    });
    for (const std::uint32_t i : order) {
        first_[i] = std::uint32_t(lumel_.size());
        lumel_.insert(lumel_.end(), parts_[i], i);
    }
}

}  // namespace lumel
