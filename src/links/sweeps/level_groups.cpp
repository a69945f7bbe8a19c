#include "links/sweeps/level_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/core/error.h"
#include "base/core/frame.h"
#include "base/core/parallel.h"
#include "links/kept/link_rows.h"

namespace lumel {
namespace {

/// Cells per side of the scene's bounds, for the groups.
constexpr int kGroupCells = 4;
/// Maximum factor of a group's correction.
constexpr double kMaxFactor = 64.0;
/// Replaces the area of a group without any.
constexpr double kMinArea = 1e-30;
/// A pivot below this means that all light of a group returns to it.
constexpr double kSingular = 1e-7;
/// Partial sums, computed in parallel.
constexpr std::size_t kSums = 16;
/// Fixed-point numbers per unit: of 1e9 links of a group each still counts to a thousandth.
constexpr double kPerUnit = double(std::int64_t(1) << 40);

}  // namespace

LevelGroups::LevelGroups(const LinkWork& work, const SubLumels& parts) : of_part(parts.count())
{
    const WorldLumels& world = work.world;
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (std::size_t i = 0; i < world.size(); ++i) {
        low = glm::min(low, world[i].centre);
        high = glm::max(high, world[i].centre);
    }
    const glm::vec3 scale =
        float(kGroupCells) / glm::max(high - low, glm::vec3(1e-6f * glm::distance(low, high)));
    std::map<int, std::uint32_t> number;
    for (std::size_t i = 0; i < world.size(); ++i) {
        const glm::ivec3 cell =
            glm::clamp(glm::ivec3((world[i].centre - low) * scale), 0, kGroupCells - 1);
        const int key = ((cell.z * kGroupCells + cell.y) * kGroupCells + cell.x) * 6 +
                        cube_side(world[i].normal);
        const auto [at, is_new] = number.try_emplace(key, std::uint32_t(number.size()));
        std::fill(of_part.begin() + parts.first(i), of_part.begin() + parts.end(i), at->second);
    }
    count = std::uint32_t(number.size());
}

struct LevelCorrection::Links {
    const LinkWork& work;
    const SubLumels& parts;
    const LinkNumbers& numbers;
    const LinkTable& table;
    const std::vector<float>& rays;
};

LevelCorrection::LevelCorrection(const LevelGroups& groups, const LinkWork& work,
                                 const SubLumels& parts, const LinkNumbers& numbers,
                                 const LinkTable& links, const std::vector<float>& rays)
    : groups_(groups),
      size_(groups.count),
      group_areas_(size_, 0.0),
      areas_(parts.count())
{
    double whole = 0.0;
    for (std::uint32_t p = 0; p < areas_.size(); ++p) {
        const std::uint32_t i = parts.lumel(p), with_cells = parts.with_cells(i);
        areas_[p] =
            p < parts.first(i) + with_cells ? work.lumels()[i].area / float(with_cells) : 0.0f;
        whole += double(areas_[p]);
    }
    const auto scale = float(double(areas_.size()) / std::max(whole, kMinArea));
    for (std::uint32_t p = 0; p < areas_.size(); ++p) {
        areas_[p] *= scale;
        group_areas_[groups.of_part[p]] += double(areas_[p]);
    }
    list_members();
    for (std::vector<double>& channel : inverse_)
        channel.assign(size_ * size_, 0.0);
    count_links({work, parts, numbers, links, rays});
    for (std::vector<double>& channel : inverse_)
        invert(channel);
}

void LevelCorrection::list_members()
{
    const std::vector<std::uint32_t>& group = groups_.of_part;
    std::vector<std::uint32_t> next(size_ + 1, 0);
    for (const std::uint32_t g : group)
        ++next[g + 1];
    for (std::size_t g = 0; g < size_; ++g)
        next[g + 1] += next[g];
    for (std::uint32_t g = 0; g < size_; ++g)
        for (std::uint32_t first = next[g]; first < next[g + 1]; first += kGroup) {
            spans_.push_back({first, std::min(first + kGroup, next[g + 1])});
            group_of_span_.push_back(g);
        }
    members_.resize(group.size());
    for (std::uint32_t p = 0; p < group.size(); ++p)
        members_[next[group[p]]++] = p;
}

LevelCorrection::Found LevelCorrection::find(std::span<const GroupSums> sums) const
{
    std::vector<glm::dvec3> change(size_, glm::dvec3(0.0)), light = change;
    for (std::size_t s = 0; s < sums.size(); ++s) {
        change[group_of_span_[s]] += glm::dvec3(sums[s].change);
        light[group_of_span_[s]] += glm::dvec3(sums[s].light);
    }
    for (std::size_t g = 0; g < size_; ++g) {
        change[g] /= std::max(group_areas_[g], kMinArea);
        light[g] /= std::max(group_areas_[g], kMinArea);
    }
    Found found{std::vector<glm::vec4>(size_, glm::vec4(0.0f)), 0.0};
    double squares = 0.0, sent = 0.0;
    // (1 - K)⁻¹ K r = (1 - K)⁻¹ r - r.
    for (std::size_t a = 0; a < size_; ++a)
        for (int c = 0; c < 3; ++c) {
            double sum = -change[a][c];
            for (std::size_t b = 0; b < size_; ++b)
                sum += inverse_[c][a * size_ + b] * change[b][c];
            const double factor = light[a][c] > 0.0 ? std::clamp(1.0 + sum / light[a][c],
                                                                 1.0 / kMaxFactor, kMaxFactor)
                                                    : 1.0;
            found.factors[a][c] = float(factor);
            const double weight = group_areas_[a] * light[a][c];
            squares += weight * (factor - 1.0) * (factor - 1.0);
            sent += weight;
        }
    found.residual = sent > 0.0 ? std::sqrt(squares / sent) : 0.0;
    return found;
}

/// 1 - K.
void LevelCorrection::count_links(const Links& links)
{
    const LinkWork& work = links.work;
    const std::size_t blocks = blocks_of(work);
    std::vector<Rows> sums(kSums, Rows(size_));
    parallel_for(kSums, 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t s = from; s < to; ++s)
            for (std::size_t b = s * blocks / kSums; b < (s + 1) * blocks / kSums; ++b)
                for (const std::vector<LinkBlock>& round : links.table.rounds)
                    if (is_own(work.ranks, b))
                        visit_rows(work, links.parts, round[b], b,
                                   [&](const LinkRow& row, std::uint32_t i) {
                                       count_row(links, i, row, sums[s]);
                                   });
    });
    std::vector<std::int64_t> all(size_ * size_ * 3, 0);
    for (const Rows& rows : sums)
        for (std::size_t a = 0; a < size_; ++a)
            for (std::size_t b = 0; b < rows[a].size(); ++b)
                for (std::size_t c = 0; c < 3; ++c)
                    all[(a * size_ + b) * 3 + c] += rows[a][b][c];
    add_up(work.ranks, all);
    for (std::size_t ab = 0; ab < size_ * size_; ++ab)
        for (std::size_t c = 0; c < 3; ++c)
            inverse_[c][ab] -= double(all[ab * 3 + c]) / kPerUnit;
    for (std::size_t g = 0; g < size_; ++g)
        for (std::vector<double>& channel : inverse_)
            channel[g * size_ + g] += 1.0;
}

void LevelCorrection::count_row(const Links& links, std::uint32_t i, const LinkRow& row,
                                Rows& sums) const
{
    const glm::dvec3 albedo(links.work.lumels()[i].albedo);
    const auto add = [&](std::size_t k, LinkEnd to, const glm::dvec3& weight) {
        if (!links.numbers.is_part(to.number()))
            return;
        const std::uint32_t end = links.numbers.part(to.number());
        if (links.rays[end] == 0.0f)
            return;
        const std::uint32_t p = links.parts.first(i) + row.leaves(links.parts, i, k);
        const std::uint32_t group = groups_.of_part[p];
        auto& sum = sums[group];
        if (sum.empty())
            sum.assign(size_, {});
        const double share = double(row.weight(k)) * double(areas_[p]) / double(links.rays[p]) /
                             std::max(group_areas_[group], kMinArea);
        for (int c = 0; c < 3; ++c)
            sum[groups_.of_part[end]][std::size_t(c)] +=
                std::llround(kPerUnit * share * albedo[c] * weight[c]);
    };
    for (std::size_t k = 0; k < row.ends.size(); ++k)
        add(k, row.ends[k], glm::dvec3(1.0));
    for (const NearLink& near : row.near)
        add(near.slot - row.first_slot, near.end, near.weight());
}

/// In place, by Gauss-Jordan elimination with diagonal pivots: 1 - K is diagonally dominant.
void LevelCorrection::invert(std::vector<double>& m) const
{
    const std::size_t n = size_;
    for (std::size_t k = 0; k < n; ++k) {
        const double pivot = m[k * n + k];
        if (!(pivot > kSingular))
            throw Error(ErrorKind::input, "albedo 1",
                        "in a closed room: light that is never absorbed grows without bound; "
                        "make some surface darker");
        m[k * n + k] = 1.0;
        for (std::size_t j = 0; j < n; ++j)
            m[k * n + j] /= pivot;
        parallel_for(n, 16, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const double factor = m[i * n + k];
                if (i == k || factor == 0.0)
                    continue;
                m[i * n + k] = 0.0;
                for (std::size_t j = 0; j < n; ++j)
                    m[i * n + j] -= factor * m[k * n + j];
            }
        });
    }
}

}  // namespace lumel
