#include "atlas/near/world_lumels.h"

#include <algorithm>
#include <cmath>

#include "atlas/near/sequence.h"
#include "base/core/parallel.h"

namespace lumel {

namespace {

/// Ray offset relative to the lumel's size: too small to see past anything.
constexpr float kLift = 1e-4f;
/// Minimum ray offset relative to the reach of the triangles: a few roundings of a float.
constexpr float kLiftOfReach = 1e-6f;
/// Maximum distance of a flat lumel's corners from its plane, relative to its size.
constexpr float kFlat = 1e-4f;
/// Opacities above this are 1 by rounding.
constexpr float kOpaque = 0.999f;

glm::vec3 area_vector(const Facet& facet)
{
    const glm::vec3* c = facet.corner;
    if (facet.count == 3)
        return 0.5f * glm::cross(c[1] - c[0], c[2] - c[0]);
    return glm::cross(c[1] - c[0], c[3] - c[0]);
}

}  // namespace

WorldLumels::WorldLumels(const Scene& scene, const RayScene& rays, const Lumels& lumels)
    : lumels_(lumels.lumels.size()),
      pieces_(lumels.pieces.size()),
      facets_(lumels.pieces.size())
{
    for (int side = 1; side <= kMaxSide; ++side)
        rules_.push_back(gauss_legendre(side));
    fit(rays);
    const std::vector<Placement> placements = placements_of(scene);
    parallel_for(lumels_.size(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            place(i, lumels, placements[lumels.lumels[i].instance]);
    });
}

void WorldLumels::fit(const RayScene& rays)
{
    extent_ = std::max({largest_coordinate(rays.low()), largest_coordinate(rays.high()),
                        glm::distance(rays.low(), rays.high())});
}

void WorldLumels::place(const Scene& scene, const Lumels& lumels,
                        std::span<const std::uint32_t> chosen)
{
    const std::vector<Placement> placements = placements_of(scene);
    for (const std::uint32_t i : chosen)
        place(i, lumels, placements[lumels.lumels[i].instance]);
}

bool WorldLumels::is_clear(std::size_t i, const RayScene& rays) const
{
    constexpr float kBelowRays = 0.5f;  // of the least height at which rays start
    constexpr float kAboveRays = 2.0f;  // of the most
    const WorldLumel& lumel = lumels_[i];
    if (!lumel.flat)
        return false;
    float across = 0.0f;  // squared
    for (const Facet* facet = begin(lumel); facet != end(lumel); ++facet)
        for (int k = 0; k < facet->count; ++k) {
            const glm::vec3 to_corner = facet->corner[k] - lumel.centre;
            across = std::max(across, glm::dot(to_corner, to_corner));
        }
    const float most = ray_offset_for(lumel.reach), least = std::min(most, lumel.ray_offset),
                height = std::max(lumel.size, kAboveRays * most);
    return rays.is_clear_above(lumel.centre, lumel.normal, std::sqrt(across + height * height),
                               kBelowRays * least);
}

/// Transforms by instance.
std::vector<WorldLumels::Placement> WorldLumels::placements_of(const Scene& scene)
{
    std::vector<Placement> placements;
    for (const Instance& instance : scene.instances) {
        const glm::mat3 linear(instance.transform);
        placements.push_back({instance.transform, glm::transpose(glm::inverse(linear))});
    }
    return placements;
}

void WorldLumels::place(std::size_t i, const Lumels& lumels, const Placement& placement)
{
    const Lumel& lumel = lumels.lumels[i];
    WorldLumel& world = lumels_[i];
    world.centre = glm::vec3(placement.points * glm::vec4(lumel.position, 1.0f));
    world.normal = glm::normalize(placement.normals * lumel.normal);
    world.size = lumel.size;
    world.reach =
        lumels.edge.empty() ? extent_ : std::max(largest_coordinate(world.centre), lumels.edge[i]);
    world.ray_offset = std::max(kLift * lumel.size, kLiftOfReach * world.reach);
    place_facets(i, lumel, &lumels.pieces[lumel.first_piece], placement);
}

void WorldLumels::place_facets(std::size_t i, const Lumel& lumel, const Piece* local,
                               const Placement& placement)
{
    const glm::mat3 linear(placement.points);
    const bool mirrored = glm::determinant(linear) < 0.0f;
    WorldLumel& world = lumels_[i];
    world.first_facet = lumel.first_piece;
    world.facet_count = lumel.piece_count;
    float area = 0.0f, bump = 0.0f;
    for (std::uint32_t p = 0; p < lumel.piece_count; ++p) {
        Piece& piece = pieces_[lumel.first_piece + p] = local[p];
        const glm::vec3 origin = piece.origin =
            glm::vec3(placement.points * glm::vec4(local[p].origin, 1.0f));
        const glm::vec3 u = piece.edge_u = linear * local[p].edge_u;
        const glm::vec3 v = piece.edge_v = linear * local[p].edge_v;
        piece.normal = glm::normalize(placement.normals * local[p].normal);

        Facet& facet = facets_[lumel.first_piece + p];
        if (piece.parallelogram != 0)
            facet = {{origin, origin + u, origin + u + v, origin + v}, 4};
        else
            facet = {{origin, origin + u, origin + v, origin}, 3};
        if (mirrored)
            std::reverse(facet.corner, facet.corner + facet.count);

        area += glm::length(area_vector(facet));
        for (int k = 0; k < facet.count; ++k)
            bump = std::max(bump, std::abs(glm::dot(world.normal, facet.corner[k] - world.centre)));
    }
    world.flat = bump <= kFlat * world.size;
    const float opacity = area > 0.0f ? lumel.area / area : 0.0f;
    world.opacity = opacity < kOpaque ? opacity : 1.0f;
}

std::vector<WeightedPoint> WorldLumels::gauss_points(std::size_t i, int side) const
{
    const std::span<const Piece> pieces = this->pieces(lumels_[i]);
    const int count = int(pieces.size()), wanted = side * side;
    std::vector<WeightedPoint> points;
    if (count > wanted) {
        for (int k = 0; k < wanted; ++k)
            points.push_back({point_on(i, sobol_pair(std::uint32_t(k), 0)), 1.0f / float(wanted)});
        return points;
    }
    const int per_side = std::max(1, int(std::lround(float(side) / std::sqrt(float(count)))));
    const std::vector<GaussPoint>& rule = rules_[std::size_t(per_side - 1)];
    float below = 0.0f;
    points.reserve(std::size_t(count) * rule.size() * rule.size());
    for (const Piece& piece : pieces) {
        for (const GaussPoint& s : rule)
            for (const GaussPoint& t : rule) {
                // In a triangle, v ends at 1 - u, so the square's side decreases with u.
                const float height = piece.parallelogram != 0 ? 1.0f : 1.0f - s.position;
                const float density = piece.parallelogram != 0 ? 1.0f : 2.0f * height;
                const glm::vec3 position =
                    piece.origin + s.position * piece.edge_u + height * t.position * piece.edge_v;
                points.push_back({{position, piece.normal},
                                  (piece.share - below) * density * s.weight * t.weight});
            }
        below = piece.share;
    }
    return points;
}

std::vector<WeightedPoint> WorldLumels::centroids(std::size_t i, int side) const
{
    const std::size_t count = std::size_t(side) * std::size_t(side);
    return {count, {{lumels_[i].centre, lumels_[i].normal}, 1.0f / float(count)}};
}

}  // namespace lumel
