// Pairs are searched on grids, one for each octave of lumel sizes: a cell is as wide as the reach
// of the largest lumels in it. A lumel looks for partners of its own octave and larger ones only,
// so the 3 × 3 × 3 cells around it always suffice; the smaller of two finds the larger.

#include "nearfield/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/parallel.h"

namespace lumel {

namespace {

/// A lumel's corner counts as above a plane from this many of the lumel's lifts on.
constexpr float kAbove = 2.0f;

/// The lumels of one octave of sizes, sorted by cell.
class Grid {
public:
    Grid(std::vector<std::uint32_t> members, const WorldLumels& world, float cell)
        : cell_(cell),
          members_(std::move(members))
    {
        low_ = high_ = world[members_.front()].centre;
        for (const std::uint32_t i : members_) {
            low_ = glm::min(low_, world[i].centre);
            high_ = glm::max(high_, world[i].centre);
        }
        std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
        order.reserve(members_.size());
        for (const std::uint32_t i : members_)
            order.emplace_back(key(cell_of(world[i].centre)), i);
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
                // Cells are sorted along x, so that three neighbours are one range.
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
    std::vector<std::uint64_t> keys_;     ///< of the cells that have members, ascending
    std::vector<std::uint32_t> starts_;   ///< first member of each
};

/// False if flat lumel `from` has all of `to` in or behind its plane.
bool may_see(const WorldLumels& world, const WorldLumel& from, const WorldLumel& to)
{
    if (!from.flat)
        return true;
    const float above = kAbove * std::min(from.lift, to.lift);
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

/// Rows from lists that hold each pair once, at its lower index.
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

    // Rows come in ascending order, so each row's lower partners do too.
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
    // Sort the lumels into octaves of size.
    std::map<int, std::vector<std::uint32_t>> octaves;
    for (std::uint32_t i = 0; i < world.size(); ++i)
        if ((lumels.lumels[i].flags & kLumelBuried) == 0 && world[i].size > 0.0f)
            octaves[std::ilogb(world[i].size)].push_back(i);
    std::map<int, Grid> grids;
    for (auto& [octave, members] : octaves)
        grids.try_emplace(octave, std::move(members), world, radius * std::ldexp(1.0f, octave + 1));

    // Every pair is found once, by the smaller octave, and within one octave by the lower index.
    std::vector<std::vector<std::uint32_t>> found(world.size());
    parallel_for(world.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const WorldLumel& a = world[i];
            if ((lumels.lumels[i].flags & kLumelBuried) != 0 || !(a.size > 0.0f))
                continue;
            const int octave = std::ilogb(a.size);
            for (auto grid = grids.lower_bound(octave); grid != grids.end(); ++grid)
                grid->second.around(a.centre, [&](std::uint32_t j) {
                    if (grid->first == octave && j <= i)
                        return;
                    const WorldLumel& b = world[j];
                    if (is_near(a.centre, a.size, b.centre, b.size, radius) &&
                        may_see(world, a, b) && may_see(world, b, a))
                        found[i].push_back(j);
                });
        }
    });

    keep_at_lower(found);
    return enter_both_sides(found);
}

}  // namespace lumel
