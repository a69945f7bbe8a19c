#include "atlas/near/moving_near_field.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "atlas/near/near_factors.h"

namespace lumel {
namespace {

/// Bounding radius of a lumel's corners about its centre [m].
float radius_of(const WorldLumels& world, const WorldLumel& lumel)
{
    float most2 = 0.0f;
    for (const Facet* facet = world.begin(lumel); facet != world.end(lumel); ++facet)
        for (int k = 0; k < facet->count; ++k) {
            const glm::vec3 offset = facet->corner[k] - lumel.centre;
            most2 = std::max(most2, glm::dot(offset, offset));
        }
    return std::sqrt(most2);
}

/// Copies the rows of lumels [first, last).
void append_rows(const NearField& from, std::size_t first, std::size_t last, NearField& into)
{
    const std::uint32_t begin = from.first[first], end = from.first[last];
    const auto shift = std::uint32_t(into.column.size()) - begin;
    into.column.insert(into.column.end(), from.column.begin() + begin, from.column.begin() + end);
    into.factor.insert(into.factor.end(), from.factor.begin() + begin, from.factor.begin() + end);
    for (std::size_t i = first; i < last; ++i)
        into.first.push_back(from.first[i + 1] + shift);
}

}  // namespace

MovingNearField::MovingNearField(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                                 const NearFieldOptions& options, std::vector<char> movers,
                                 NearPairsOf which)
    : lumels_(&lumels),
      options_(options),
      movers_(std::move(movers)),
      which_(which),
      world_(scene, rays, lumels)
{
    for (std::size_t i = 0; i < world_.size(); ++i) {
        radius_of_.push_back(radius_of(world_, world_[i]));
        most_radius_ = std::max(most_radius_, radius_of_[i]);
        most_lift_ = std::max(most_lift_, world_[i].ray_offset);
        most_size_ = std::max(most_size_, world_[i].size);
    }
    table_.radius = fitting_radius(world_, options.radius, options.most_pairs);
    table_.first.assign(world_.size() + 1, 0);
    std::vector<std::uint32_t> all(world_.size());
    std::iota(all.begin(), all.end(), 0u);
    build(rays, std::move(all), [&](std::uint32_t i, std::uint32_t j) { return is_of(i, j); });
}

void MovingNearField::follow(const Scene& scene, const RayScene& rays,
                             std::span<const std::uint32_t> moved, std::span<const Box> boxes)
{
    std::vector<char> has_moved(scene.instances.size(), 0);
    for (const std::uint32_t instance : moved)
        has_moved[instance] = 1;
    const auto moves = [&](std::uint32_t i) { return has_moved[lumels_->lumels[i].instance] != 0; };
    std::vector<std::uint32_t> placed;
    for (std::uint32_t i = 0; i < world_.size(); ++i)
        if (moves(i))
            placed.push_back(i);
    world_.fit(rays);
    world_.place(scene, *lumels_, placed);
    for (const std::uint32_t i : placed)
        most_lift_ = std::max(most_lift_, world_[i].ray_offset);
    std::vector<std::uint32_t> some;
    const std::vector<std::uint32_t> near = lumels_near(boxes);
    std::set_union(near.begin(), near.end(), placed.begin(), placed.end(),
                   std::back_inserter(some));
    build(rays, std::move(some), [&](std::uint32_t i, std::uint32_t j) {
        return is_of(i, j) && (moves(i) || moves(j) || may_cross(i, j, boxes));
    });
}

bool MovingNearField::is_of(std::uint32_t i, std::uint32_t j) const
{
    return which_ == NearPairsOf::all || movers_[lumels_->lumels[i].instance] ||
           movers_[lumels_->lumels[j].instance];
}

/// Segments between two balls are within the larger radius of the segment between their centres.
/// Symmetric in i and j, despite rounding.
bool MovingNearField::may_cross(std::uint32_t i, std::uint32_t j, std::span<const Box> boxes) const
{
    if (j < i)
        std::swap(i, j);
    const glm::vec3 path = world_[j].centre - world_[i].centre;
    const float length = glm::length(path);
    const glm::vec3 direction = length > 0.0f ? path / length : path;
    const float margin = std::max(radius_of_[i], radius_of_[j]) +
                         std::max(world_[i].ray_offset, world_[j].ray_offset);
    return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
        return box.may_meet(world_[i].centre, direction, length, margin);
    });
}

/// A superset of the lumels of pairs that may cross a box: such a segment is within a corner of the
/// box, grown by the margin, and at most the pair's distance long.
std::vector<std::uint32_t> MovingNearField::lumels_near(std::span<const Box> boxes) const
{
    const float corner = std::sqrt(3.0f) * (most_radius_ + most_lift_);
    const float reach = table_.radius * most_size_ + corner;
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < world_.size(); ++i)
        if (std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
                return box.distance2(world_[i].centre) < reach * reach;
            }))
            near.push_back(i);
    return near;
}

/// Replaces the factors of the wanted pairs of some lumels.
void MovingNearField::build(const RayScene& rays, std::vector<std::uint32_t> some,
                            const WantsPair& wants)
{
    const NearPairs pairs =
        find_near_pairs(world_, *lumels_, table_.radius, std::move(some), wants);
    const std::vector<float> factors = near_factors(pairs, rays, world_, *lumels_, options_);
    NearField next;
    next.radius = table_.radius;
    next.first.reserve(table_.first.size());
    next.column.reserve(table_.column.size());
    next.factor.reserve(table_.factor.size());
    next.first.push_back(0);
    std::vector<std::uint32_t> columns;
    for (std::size_t row = 0; row < pairs.rows(); ++row) {
        append_rows(table_, next.first.size() - 1, pairs.lumel[row], next);
        columns.clear();
        for (std::size_t k = pairs.first[row]; k < pairs.first[row + 1]; ++k)
            columns.push_back(pairs.partner_of(k));
        merge(pairs.lumel[row], columns,
              std::span(factors).subspan(pairs.first[row], columns.size()), wants, next);
    }
    append_rows(table_, next.first.size() - 1, world_.size(), next);
    table_ = std::move(next);
}

/// Appends a lumel's row: its old entries except rebuilt pairs, merged with the new ones.
void MovingNearField::merge(std::uint32_t lumel, std::span<const std::uint32_t> columns,
                            std::span<const float> factors, const WantsPair& wants, NearField& into)
{
    const std::uint32_t begin = table_.first[lumel], end = table_.first[lumel + 1];
    const auto unlimited = unlimited_.find(lumel);
    const float* kept =
        unlimited == unlimited_.end() ? table_.factor.data() + begin : unlimited->second.data();
    const std::size_t start = into.column.size();
    const auto append = [&](std::uint32_t column, float factor) {
        into.column.push_back(column);
        into.factor.push_back(factor);
    };
    std::size_t fresh = 0;
    const auto append_fresh_before = [&](std::uint32_t column) {
        for (; fresh < columns.size() && columns[fresh] < column; ++fresh)
            if (factors[fresh] >= kMinFactor)
                append(columns[fresh], factors[fresh]);
    };
    for (std::uint32_t k = begin; k < end; ++k) {
        if (wants(lumel, table_.column[k]))
            continue;
        append_fresh_before(table_.column[k]);
        append(table_.column[k], kept[k - begin]);
    }
    append_fresh_before(std::numeric_limits<std::uint32_t>::max());
    const std::span<float> row = std::span(into.factor).subspan(start);
    std::vector<float> before(row.begin(), row.end());
    if (limit_row(row))
        unlimited_[lumel] = std::move(before);
    else if (unlimited != unlimited_.end())
        unlimited_.erase(unlimited);
    into.first.push_back(std::uint32_t(into.column.size()));
}

}  // namespace lumel
