#include "atlas/cells/cells.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

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

/// Distance of points near the corners of a flat lumel from them, in its ray offsets.
constexpr float kInsideCorner = 2.0f;

/// Joins cells at an offset from each other whose points are mutually visible.
void join_along(const SeenCells& seen, int dx, int dy, Joined& joined)
{
    const CellPoints& points = seen.points();
    for (int y = 0; y + dy < kCellSide; ++y)
        for (int x = std::max(0, -dx); x < kCellSide && x + dx < kCellSide; ++x) {
            const auto a = std::uint32_t(y * kCellSide + x);
            const auto b = std::uint32_t((y + dy) * kCellSide + x + dx);
            if (!points.has(a) || !points.has(b) || joined.root(a) == joined.root(b))
                continue;
            if (seen.sees(points.point[a], b))
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

/// Points just inside the corners of a lumel's facets.
template <class Visit>
void for_each_corner(const WorldLumels& world, std::size_t i, const Visit& visit)
{
    const WorldLumel& lumel = world[i];
    const float inside = kInsideCorner * ray_offset_for(lumel.reach);
    for (auto facet = world.begin(lumel); facet != world.end(lumel); ++facet)
        for (int k = 0; k < facet->count; ++k) {
            const glm::vec3 to_centre = lumel.centre - facet->corner[k];
            const float distance = glm::length(to_centre);
            if (distance > inside)
                visit(LumelPoint{facet->corner[k] + inside / distance * to_centre, lumel.normal});
        }
}

/// True if a corner of a flat lumel does not see the nearest cell: geometry covers a sliver of it
/// that no cell's point is in.
bool has_sliver(const WorldLumels& world, std::size_t i, const SeenCells& seen)
{
    bool found = false;
    if (world[i].flat)
        for_each_corner(world, i, [&](const LumelPoint& corner) {
            found = found || !seen.sees(corner, seen.points().nearest(corner.position));
        });
    return found;
}

/// True if rays along the normal, as long as the lumel's side, meet something from some points of a
/// flat lumel but not from others.
bool is_half_covered(const WorldLumels& world, const RayScene& rays, std::size_t i,
                     const CellPoints& points, std::uint32_t seed)
{
    const WorldLumel& lumel = world[i];
    if (!lumel.flat)
        return false;
    const float ray_offset = ray_offset_for(lumel.reach);
    bool covered = false, open = false;
    const auto look = [&](const LumelPoint& from) {
        if (covered && open)
            return;
        const bool sees = rays.sees(from.position + ray_offset * lumel.normal,
                                    from.position + lumel.size * lumel.normal, 0.0f, seed);
        (sees ? open : covered) = true;
    };
    for_each_corner(world, i, look);
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c)
        if (points.has(c))
            look(points.point[c]);
    return covered && open;
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

std::uint32_t CellPoints::nearest(const glm::vec3& position) const
{
    std::uint32_t found = 0;
    float least = std::numeric_limits<float>::max();
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c) {
        const glm::vec3 apart = point[c].position - position;
        if (has(c) && glm::dot(apart, apart) < least) {
            least = glm::dot(apart, apart);
            found = c;
        }
    }
    return found;
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

SeenCells::SeenCells(const WorldLumels& world, const Cells& cells, const RayScene& rays,
                     std::size_t i, std::uint32_t seed)
    : rays_(rays),
      points_(cell_points(world, cells, i)),
      flat_(world[i].flat),
      ray_offset_(std::max(kAboveCell * world[i].size, ray_offset_for(world[i].reach))),
      seed_(seed)
{
}

bool SeenCells::sees(const LumelPoint& from, std::uint32_t cell) const
{
    const LumelPoint& to = points_.point[cell];
    return rays_.sees(from.position + ray_offset_ * from.normal,
                      to.position + ray_offset_ * to.normal, 0.0f, seed_);
}

std::uint32_t SeenCells::nearest(const LumelPoint& from) const
{
    const std::uint32_t own = points_.nearest(from.position);
    if (points_.has(own) && sees(from, own))
        return own;
    std::array<std::pair<float, std::uint32_t>, kCells> by_distance;
    std::size_t count = 0;
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c)
        if (points_.has(c)) {
            const glm::vec3 apart = points_.point[c].position - from.position;
            by_distance[count++] = {glm::dot(apart, apart), c};
        }
    std::sort(by_distance.begin(), by_distance.begin() + std::ptrdiff_t(count));
    for (std::size_t n = 0; n < count; ++n)
        if (by_distance[n].second != own && sees(from, by_distance[n].second))
            return by_distance[n].second;
    return kNoCell;
}

std::uint32_t SeenCells::nearest_or(const LumelPoint& from, std::uint32_t own) const
{
    const std::uint32_t cell = nearest(from);
    return cell == kNoCell && !flat_ ? own : cell;
}

std::uint32_t SubLumels::seed_of(std::size_t lumel) const
{
    return PathSamples::hash(seed_, lumel_key(lumels_.lumels[lumel], std::uint32_t(lumels_.width)));
}

SeenCells SubLumels::seen_cells(std::size_t lumel) const
{
    return {world_, cells_, rays_, lumel, seed_of(lumel)};
}

SubLumels::SubLumels(const WorldLumels& world, const Cells& cells, const RayScene& rays,
                     const Lumels& lumels, const std::vector<std::uint32_t>& order,
                     std::uint32_t seed)
    : world_(world),
      cells_(cells),
      rays_(rays),
      lumels_(lumels),
      seed_(seed),
      first_(world.size(), 0),
      flags_(world.size(), 0),
      parts_(world.size(), 1),
      code_(world.size(), 0)
{
    parallel_for(world.size(), kCellsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (lumels.lumels[i].flags & kLumelBuried)
                continue;
            const SeenCells seen = seen_cells(i);
            Joined joined;
            join_along(seen, 1, 0, joined);
            join_along(seen, 0, 1, joined);
            join_along(seen, 1, 1, joined);
            join_along(seen, -1, 1, joined);
            parts_[i] = std::uint8_t(number_parts(seen.points(), joined, code_[i]));
            if (is_cut(i) || has_sliver(world, i, seen))
                flags_[i] |= kHasHidden;
            if (lumel::is_half_covered(world, rays, i, seen.points(), seed_of(i)))
                flags_[i] |= kHalfCovered;
        }
    });
    for (const std::uint32_t i : order) {
        first_[i] = std::uint32_t(lumel_.size());
        lumel_.insert(lumel_.end(), parts_[i], i);
    }
}

}  // namespace lumel
