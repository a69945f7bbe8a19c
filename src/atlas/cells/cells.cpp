#include "atlas/cells/cells.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "atlas/cells/ray_origins.h"
#include "base/core/parallel.h"
#include "base/ranks/rank_blocks.h"
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

/// A batch of rays, and their transmittance.
struct RaysTogether {
    std::vector<RaySpan> rays;
    std::vector<glm::vec3> transmittance;  ///< [rays]

    void cast(const RayScene& scene)
    {
        transmittance.resize(rays.size());
        scene.transmittance(rays, transmittance);
    }
    bool sees(std::size_t ray) const { return transmittance[ray] != glm::vec3(0.0f); }
};

/// Joins cells at an offset from each other whose points are mutually visible; all of them if
/// nothing can stand between.
void join_along(const SeenCells& seen, bool is_clear, int dx, int dy, const RayScene& scene,
                RaysTogether& cast, Joined& joined)
{
    const CellPoints& points = seen.points();
    std::array<std::pair<std::uint32_t, std::uint32_t>, kCells> pairs;
    cast.rays.clear();
    for (int y = 0; y + dy < kCellSide; ++y)
        for (int x = std::max(0, -dx); x < kCellSide && x + dx < kCellSide; ++x) {
            const auto a = std::uint32_t(y * kCellSide + x);
            const auto b = std::uint32_t((y + dy) * kCellSide + x + dx);
            if (!points.has(a) || !points.has(b) || joined.root(a) == joined.root(b))
                continue;
            if (is_clear) {
                joined.join(a, b);
                continue;
            }
            pairs[cast.rays.size()] = {a, b};
            cast.rays.push_back(seen.ray_to(points.point[a], b));
        }
    cast.cast(scene);
    for (std::size_t n = 0; n < cast.rays.size(); ++n)
        if (cast.sees(n))
            joined.join(pairs[n].first, pairs[n].second);
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

/// Occlusion of a lumel by geometry just above it.
struct Cover {
    /// A corner does not see the nearest cell: geometry covers a sliver of the lumel that no cell's
    /// point is in.
    bool has_sliver = false;
    /// Rays along the normal, as long as the lumel's side, meet something from some points but not
    /// from others.
    bool is_half = false;
};

Cover find_cover(const WorldLumels& world, const RayScene& scene, std::size_t i,
                 const SeenCells& seen, std::uint32_t seed, RaysTogether& cast)
{
    const WorldLumel& lumel = world[i];
    Cover cover;
    cast.rays.clear();
    if (lumel.flat)
        for_each_corner(world, i, [&](const LumelPoint& corner) {
            cast.rays.push_back(seen.ray_to(corner, seen.points().nearest(corner.position)));
        });
    else
        for_each_corner(world, i, [&](const LumelPoint& corner) {
            cover.has_sliver = cover.has_sliver || seen.nearest(corner) == kNoCell;
        });
    const std::size_t corners = cast.rays.size();
    const float ray_offset = ray_offset_for(lumel.reach);
    const auto look_up = [&](const LumelPoint& from) {
        cast.rays.push_back(ray_between(from.position + ray_offset * from.normal,
                                        from.position + lumel.size * from.normal, 0.0f, seed));
    };
    if (lumel.flat)
        for_each_corner(world, i, look_up);
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c)
        if (seen.points().has(c))
            look_up(seen.points().point[c]);
    cast.cast(scene);
    const std::span<const glm::vec3> to_cells = std::span(cast.transmittance).first(corners),
                                     up = std::span(cast.transmittance).subspan(corners);
    const auto blocked = [](std::span<const glm::vec3> rays) {
        return std::size_t(std::ranges::count(rays, glm::vec3(0.0f)));
    };
    cover.has_sliver = cover.has_sliver || blocked(to_cells) > 0;
    cover.is_half = blocked(up) > 0 && blocked(up) < up.size();
    return cover;
}

/// Stores two bits per cell: the number of its sub-lumel in the lumel. Returns the number of
/// sub-lumels.
std::uint32_t number_parts(const CellPoints& points, const Joined& joined, std::uint32_t& code)
{
    std::array<std::uint32_t, kCells> number{};
    std::uint32_t parts = 0;
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c)
        if (points.has(c) && joined.root(c) == c)
            number[c] = std::min(parts++, kMaxWithCells - 1);
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c) {
        const std::uint32_t used = points.has(c) ? c : nearest_used(points, c);
        code |= number[joined.root(used)] << 2 * c;
    }
    return std::clamp(parts, 1u, kMaxWithCells);
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
    for (const Piece& piece : world.pieces(world[i]))
        for (int y = 0; y < kCellSide; ++y)
            for (int x = 0; x < kCellSide; ++x) {
                const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / float(kCellSide);
                const LumelPoint point = point_in(piece, at.x, at.y);
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
      up_(world[i].normal),
      top_(-std::numeric_limits<float>::max()),
      ray_offset_(std::max(kAboveCell * world[i].size, ray_offset_for(world[i].reach))),
      seed_(seed)
{
    if (flat_)
        return;
    for (auto facet = world.begin(world[i]); facet != world.end(world[i]); ++facet)
        for (int k = 0; k < facet->count; ++k)
            top_ = std::max(top_, glm::dot(facet->corner[k], up_));
    top_ += 2.0f * ray_offset_;
}

RaySpan SeenCells::ray_to(const LumelPoint& from, std::uint32_t cell) const
{
    const LumelPoint& to = points_.point[cell];
    return ray_between(from.position + ray_offset_ * from.normal,
                       to.position + ray_offset_ * to.normal, 0.0f, seed_);
}

bool SeenCells::sees(const LumelPoint& from, std::uint32_t cell) const
{
    return rays_.transmittance(ray_to(from, cell)) != glm::vec3(0.0f);
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
    return !flat_ && points_.has(own) && sees_over(from, own) ? own : kNoCell;
}

/// True if nothing stands between the point and the cell but the lumel itself: on a path above it.
bool SeenCells::sees_over(const LumelPoint& from, std::uint32_t cell) const
{
    const auto above = [&](const LumelPoint& point) {
        return point.position + (top_ - glm::dot(point.position, up_)) * up_;
    };
    const auto lifted = [&](const LumelPoint& point) {
        return point.position + ray_offset_ * point.normal;
    };
    const LumelPoint& to = points_.point[cell];
    return rays_.sees(lifted(from), above(from), 0.0f, seed_) &&
           rays_.sees(above(from), above(to), 0.0f, seed_) &&
           rays_.sees(above(to), lifted(to), 0.0f, seed_);
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
                     std::uint32_t seed, Ranks* ranks)
    : world_(world),
      cells_(cells),
      rays_(rays),
      lumels_(lumels),
      seed_(seed),
      first_(world.size(), 0),
      flags_(world.size(), 0),
      with_cells_(world.size(), 1),
      code_(world.size(), 0)
{
    const auto end_of = [&](std::size_t block) {
        return std::min((block + 1) * kCellsPerTask, world.size());
    };
    const std::size_t blocks = (world.size() + kCellsPerTask - 1) / kCellsPerTask;
    parallel_for_own(ranks, 0, blocks, 1, [&](std::size_t first, std::size_t last) {
        RaysTogether cast;
        for (std::size_t i = first * kCellsPerTask; i < end_of(last - 1); ++i) {
            if (lumels.lumels[i].flags & kLumelBuried)
                continue;
            const SeenCells seen = seen_cells(i);
            const bool is_clear = world.is_clear(i, rays);
            Joined joined;
            for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {1, 1}, {-1, 1}})
                join_along(seen, is_clear, dx, dy, rays, cast, joined);
            with_cells_[i] = std::uint8_t(number_parts(seen.points(), joined, code_[i]));
            const Cover cover =
                is_clear ? Cover{} : find_cover(world, rays, i, seen, seed_of(i), cast);
            if (is_cut(i) || cover.has_sliver)
                flags_[i] |= kHasHidden;
            if (cover.is_half)
                flags_[i] |= kHalfCovered;
        }
    });
    share_blocks(ranks, 0, blocks, [&](auto& archive, std::size_t b) {
        for (std::size_t i = b * kCellsPerTask; i < end_of(b); ++i)
            archive(flags_[i], with_cells_[i], code_[i]);
    });
    for (const std::uint32_t i : order) {
        first_[i] = std::uint32_t(lumel_.size());
        lumel_.insert(lumel_.end(), end(i) - first_[i], i);
    }
}

}  // namespace lumel
