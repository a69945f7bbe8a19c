// Pairs are found with grids, one per octave of lumel sizes: cells are as wide as the search
// radius of the largest lumels in it. A lumel searches for partners in its own octave and larger
// ones, so the 3 × 3 × 3 cells around it suffice; the smaller lumel finds the larger.

#include "atlas/near/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/core/parallel.h"

namespace lumel {

namespace {

/// Minimum height of a corner above a plane, in the lumel's ray offsets.
constexpr float kAbove = 2.0f;

/// The lumels of an octave of sizes, sorted by cell.
class Grid {
public:
    /// members: rows, as indices into `lumels`.
    Grid(std::vector<std::uint32_t> members, const std::vector<std::uint32_t>& lumels,
         const WorldLumels& world, float cell)
        : cell_(cell),
          members_(std::move(members))
    {
        low_ = high_ = world[lumels[members_.front()]].centre;
        for (const std::uint32_t row : members_) {
            low_ = glm::min(low_, world[lumels[row]].centre);
            high_ = glm::max(high_, world[lumels[row]].centre);
        }
        std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
        order.reserve(members_.size());
        for (const std::uint32_t row : members_)
            order.emplace_back(key(cell_of(world[lumels[row]].centre)), row);
        std::sort(order.begin(), order.end());
        for (std::size_t k = 0; k < order.size(); ++k) {
            members_[k] = order[k].second;
            if (k == 0 || order[k].first != order[k - 1].first) {
                keys_.push_back(order[k].first);
                starts_.push_back(std::uint32_t(k));
            }
        }
        starts_.push_back(std::uint32_t(members_.size()));
    }

    /// Calls visit(j) for every member in the cells around a point.
    template <class Visit>
    void around(const glm::vec3& point, const Visit& visit) const
    {
        if (glm::any(glm::lessThan(point, low_ - cell_)) ||
            glm::any(glm::greaterThan(point, high_ + cell_)))
            return;
        const glm::ivec3 centre = cell_of(point);
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y) {
                // Cells are sorted along x, so three neighbours are one range.
                const std::uint64_t from = key(centre + glm::ivec3(-1, y, z));
                auto at =
                    std::size_t(std::lower_bound(keys_.begin(), keys_.end(), from) - keys_.begin());
                for (; at < keys_.size() && keys_[at] <= from + 2; ++at)
                    for (std::uint32_t k = starts_[at]; k < starts_[at + 1]; ++k)
                        visit(members_[k]);
            }
    }

private:
    glm::ivec3 cell_of(const glm::vec3& point) const
    {
        return glm::ivec3(glm::floor((point - low_) / cell_)) + 2;  // + 2: neighbours stay positive
    }
    static std::uint64_t key(const glm::ivec3& cell)
    {
        constexpr int kBits = 21;
        return (std::uint64_t(cell.z) << 2 * kBits) | (std::uint64_t(cell.y) << kBits) |
               std::uint64_t(cell.x);
    }

    float cell_;
    glm::vec3 low_, high_;
    std::vector<std::uint32_t> members_;  ///< in order of their cells
    std::vector<std::uint64_t> keys_;     ///< ascending keys of non-empty cells
    std::vector<std::uint32_t> starts_;   ///< first member of each cell
};

/// False if flat lumel `from` has all of `to` in or behind its plane.
bool may_see(const WorldLumels& world, const WorldLumel& from, const WorldLumel& to)
{
    if (!from.flat)
        return true;
    const float above = kAbove * std::min(from.ray_offset, to.ray_offset);
    for (const Facet* facet = world.begin(to); facet != world.end(to); ++facet)
        for (int k = 0; k < facet->count; ++k)
            if (glm::dot(from.normal, facet->corner[k] - from.centre) > above)
                return true;
    return false;
}

/// Moves every pair to the list of its lower index, and sorts the lists.
void keep_at_lower(std::vector<std::vector<std::uint32_t>>& found)
{
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        const auto lower = std::partition(found[i].begin(), found[i].end(),
                                          [i](std::uint32_t j) { return j > i; });
        for (auto j = lower; j != found[i].end(); ++j)
            found[*j].push_back(i);
        found[i].erase(lower, found[i].end());
    }
    parallel_for(found.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            std::sort(found[i].begin(), found[i].end());
    });
}

/// Rows from lists with each pair once, at its lower index.
NearPairs enter_both_sides(const std::vector<std::vector<std::uint32_t>>& found)
{
    NearPairs pairs;
    pairs.first.assign(found.size() + 1, 0);
    for (std::size_t i = 0; i < found.size(); ++i) {
        pairs.first[i + 1] += found[i].size();
        for (const std::uint32_t j : found[i])
            ++pairs.first[j + 1];
    }
    for (std::size_t i = 0; i < found.size(); ++i)
        pairs.first[i + 1] += pairs.first[i];

    // Rows are processed in ascending order, so each row's lower partners ascend too.
    pairs.partner.resize(pairs.first.back());
    pairs.mirror.resize(pairs.first.back());
    pairs.middle.assign(pairs.first.begin(), pairs.first.end() - 1);
    for (std::uint32_t i = 0; i < found.size(); ++i)
        for (std::size_t k = 0; k < found[i].size(); ++k) {
            const std::uint32_t j = found[i][k];
            const std::size_t here = pairs.middle[i] + k, there = pairs.middle[j]++;
            pairs.partner[here] = j;
            pairs.partner[there] = i;
            pairs.mirror[here] = std::uint32_t(there);
        }
    return pairs;
}

}  // namespace

NearPairs find_near_pairs(const WorldLumels& world, const Lumels& lumels, float radius)
{
    std::vector<std::uint32_t> all(world.size());
    std::iota(all.begin(), all.end(), 0u);
    return find_near_pairs(world, lumels, radius, std::move(all), {});
}

NearPairs find_near_pairs(const WorldLumels& world, const Lumels& lumels, float radius,
                          std::vector<std::uint32_t> some, const WantsPair& wants)
{
    const auto has_partners = [&](std::uint32_t i) {
        return (lumels.lumels[i].flags & kLumelBuried) == 0 && world[i].size > 0.0f;
    };
    // Groups the rows by octave of size.
    std::map<int, std::vector<std::uint32_t>> octaves;
    for (std::uint32_t row = 0; row < some.size(); ++row)
        if (has_partners(some[row]))
            octaves[std::ilogb(world[some[row]].size)].push_back(row);
    std::map<int, Grid> grids;
    for (auto& [octave, rows] : octaves)
        grids.try_emplace(octave, std::move(rows), some, world,
                          radius * std::ldexp(1.0f, octave + 1));

    // Each pair is found once, by the smaller octave, and within an octave by the lower row.
    std::vector<std::vector<std::uint32_t>> found(some.size());
    parallel_for(some.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            if (!has_partners(some[row]))
                continue;
            const WorldLumel& a = world[some[row]];
            const int octave = std::ilogb(a.size);
            for (auto grid = grids.lower_bound(octave); grid != grids.end(); ++grid)
                grid->second.around(a.centre, [&](std::uint32_t other) {
                    if (grid->first == octave && other <= row)
                        return;
                    const WorldLumel& b = world[some[other]];
                    if (is_near(a.centre, a.size, b.centre, b.size, radius) &&
                        (!wants || wants(some[row], some[other])) && may_see(world, a, b) &&
                        may_see(world, b, a))
                        found[row].push_back(other);
                });
        }
    });

    keep_at_lower(found);
    NearPairs pairs = enter_both_sides(found);
    pairs.lumel = std::move(some);
    return pairs;
}

/// About half of the neighbours lie in the same plane and form no pair.
float fitting_radius(const WorldLumels& world, float radius, std::size_t most_pairs)
{
    constexpr std::size_t kJudged = 512;
    constexpr float kShrink = 0.75f, kMinRadius = 1.5f;
    const std::size_t step = std::max<std::size_t>(world.size() / kJudged, 1);
    for (;; radius *= kShrink) {
        std::size_t neighbours = 0, judged = 0;
        for (std::size_t i = 0; i < world.size(); i += step, ++judged)
            for (std::size_t j = 0; j < world.size(); ++j)
                neighbours +=
                    is_near(world[i].centre, world[i].size, world[j].centre, world[j].size,
                            radius) &&
                    std::abs(glm::dot(world[i].normal, world[j].centre - world[i].centre)) >
                        world[i].ray_offset;
        const double pairs =
            double(neighbours) / double(std::max<std::size_t>(judged, 1)) * double(world.size());
        if (pairs <= double(most_pairs) || radius <= kMinRadius)
            return radius;
    }
}

}  // namespace lumel
