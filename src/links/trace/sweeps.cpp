#include "links/trace/sweeps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/core/error.h"
#include "base/core/frame.h"
#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Cells per side of the scene's bounds, for the groups.
constexpr int kGroupCells = 4;
/// Sweeps before the factor between changes is used.
constexpr int kFirstSweeps = 2;
/// Sweeps before groups are made, and those that would have to follow: the first corrections raise
/// the change where groups hold cavities of their own light, which takes about as many sweeps.
constexpr int kPlainSweeps = 10, kWorthGroups = 12;
/// For the residual, sub-lumels darker than this × the mean count as that bright.
constexpr double kDarkestCounted = 1e-4;
constexpr int kSweepLimit = 2000;
/// Maximum factor of a group's correction.
constexpr double kMaxFactor = 64.0;
/// Replaces the area of an empty group [m²].
constexpr double kMinArea = 1e-30;
/// Blocks per task.
constexpr std::size_t kBlocksPerTask = 4;
/// Partial sums, computed in parallel: a fixed number, so that results do not depend on the number
/// of cores.
constexpr std::size_t kSums = 16;
/// Minimum assumed convergence: changes shrink at least by this factor.
constexpr double kSlowestSweep = 1.0 - 1e-6;
/// A pivot below this means that all light of a group returns to it.
constexpr double kSingular = 1e-7;

template <std::size_t Lanes>
using Light = std::vector<LaneLight<Lanes>>;

/// Mean over sub-lumels, summed over channels.
template <std::size_t Lanes>
double mean_of(const Light<Lanes>& sent, std::size_t lane, std::size_t parts)
{
    double sum = 0.0;
    for (const LaneLight<Lanes>& light : sent)
        sum += double(light[lane].x + light[lane].y + light[lane].z);
    return sum / double(std::max<std::size_t>(parts, 1));
}

template <std::size_t Lanes>
void add(LaneLight<Lanes>& sum, const LaneLight<Lanes>& light)
{
    for (std::size_t lane = 0; lane < Lanes; ++lane)
        sum[lane] += light[lane];
}

template <std::size_t Lanes>
void add(LaneLight<Lanes>& sum, float weight, const LaneLight<Lanes>& light)
{
    for (std::size_t lane = 0; lane < Lanes; ++lane)
        sum[lane] += weight * light[lane];
}

template <std::size_t Lanes>
void add_near(LaneLight<Lanes>& sum, const LinkRow& row, const NearLink& near,
              const Light<Lanes>& sent)
{
    const glm::vec4 passed(near.weight(), 0.0f);
    const float weight = row.weight(near.slot - row.first_slot);
    for (std::size_t lane = 0; lane < Lanes; ++lane)
        sum[lane] += weight * sent[near.end.number()][lane] * passed;
}

/// Adds the light along the rays of a row to the sub-lumels of lumel i, which is cut.
template <std::size_t Lanes>
void add_row(const LinkRow& row, const SubLumels& parts, std::size_t i, const Light<Lanes>& sent,
             std::array<LaneLight<Lanes>, kMaxParts>& sums)
{
    for (std::size_t k = 0; k < row.ends.size(); ++k)
        add(sums[row.leaves(parts, i, k)], row.weight(k), sent[row.ends[k].number()]);
    for (const NearLink& near : row.near)
        add_near(sums[row.leaves(parts, i, near.slot - row.first_slot)], row, near, sent);
}

/// `sum` with the light along the rays of a row, of a lumel that is not cut.
template <std::size_t Lanes>
LaneLight<Lanes> sum_of_row(const LinkRow& row, const Light<Lanes>& sent, LaneLight<Lanes> sum)
{
    if (row.probabilities)
        for (std::size_t k = 0; k < row.ends.size(); ++k)
            add(sum, row.weight(k), sent[row.ends[k].number()]);
    else
        for (const LinkEnd end : row.ends)
            add(sum, sent[end.number()]);
    for (const NearLink& near : row.near)
        add_near(sum, row, near, sent);
    return sum;
}

/// Changes of the sent light in a sweep, relative to each sub-lumel's own, of each lane.
template <std::size_t Lanes>
struct Change {
    std::array<double, Lanes> squares{};
    std::array<std::size_t, Lanes> count{};

    void add(std::size_t lane, const glm::vec4& before, const glm::vec4& after, double floor)
    {
        const double now = double(after.x + after.y + after.z);
        const double then = double(before.x + before.y + before.z);
        if (!(now > 0.0))
            return;
        const double relative = (now - then) / (now + floor);
        squares[lane] += relative * relative;
        ++count[lane];
    }
    void add(const Change& other)
    {
        for (std::size_t lane = 0; lane < Lanes; ++lane) {
            squares[lane] += other.squares[lane];
            count[lane] += other.count[lane];
        }
    }
    double size(std::size_t lane) const
    {
        return count[lane] > 0 ? std::sqrt(squares[lane] / double(count[lane])) : 0.0;
    }
};

}  // namespace

/// Corrects the level of groups after a sweep x → y of the reflected light. With K_ab the
/// fraction of group a's received light that comes from b, times ρ, and r_a the mean change of a,
/// the mean residual of a is (1 - K)⁻¹ K r. It is distributed in proportion to the light that
/// sub-lumels send, so that none is added to dark cavities, which would lose it slowly.
class LinkSolver::Groups {
public:
    Groups(const LinkSolver& solver, const System& system)
        : solver_(solver),
          size_(solver.group_count_)
    {
        const std::size_t cells = std::size_t(size_) * size_;
        for (int c = 0; c < 3; ++c)
            inverse_[c].assign(cells, 0.0);
        const std::vector<Lumel>& lumels = solver.work_.lumels();
        area_of_part_.resize(solver.parts_.count());
        area_.assign(size_, 0.0);
        for (std::uint32_t p = 0; p < area_of_part_.size(); ++p) {
            const std::uint32_t i = solver.parts_.lumel(p);
            area_of_part_[p] =
                lumels[i].area / float(solver.parts_.end(i) - solver.parts_.first(i));
            area_[solver.group_[p]] += double(area_of_part_[p]);
        }
        count_links(system);
        for (int c = 0; c < 3; ++c)
            invert(inverse_[c]);
    }

    /// Adds the estimated residual to `now`; before: light before the sweep. Returns its RMS
    /// relative to the light of the groups.
    template <std::size_t Lanes>
    double correct(const Light<Lanes>& before, Light<Lanes>& now, std::size_t lane) const
    {
        const auto [change, mean] = means(before, now, lane);
        std::vector<glm::dvec3> factor(size_);
        // (1 - K)⁻¹ K r = (1 - K)⁻¹ r - r.
        for (std::uint32_t a = 0; a < size_; ++a)
            for (int c = 0; c < 3; ++c) {
                double sum = -change[a][c];
                for (std::uint32_t b = 0; b < size_; ++b)
                    sum += inverse_[c][std::size_t(a) * size_ + b] * change[b][c];
                factor[a][c] = mean[a][c] > 0.0 ? std::clamp(1.0 + sum / mean[a][c],
                                                             1.0 / kMaxFactor, kMaxFactor)
                                                : 1.0;
            }
        for_each_span(area_of_part_.size(), [&](std::size_t, std::size_t first, std::size_t last) {
            for (std::size_t p = first; p < last; ++p)
                now[solver_.numbers_.of_part(std::uint32_t(p))][lane] *=
                    glm::vec4(factor[solver_.group_[p]], 0.0);
        });
        double squares = 0.0, sent = 0.0;
        for (std::uint32_t g = 0; g < size_; ++g)
            for (int c = 0; c < 3; ++c) {
                const double weight = area_[g] * mean[g][c];
                squares += weight * (factor[g][c] - 1.0) * (factor[g][c] - 1.0);
                sent += weight;
            }
        return sent > 0.0 ? std::sqrt(squares / sent) : 0.0;
    }

private:
    /// Of each group [groups].
    struct Means {
        std::vector<glm::dvec3> change, light;
    };

    /// Means over the areas of groups, of the change and of the light after a sweep.
    template <std::size_t Lanes>
    Means means(const Light<Lanes>& before, const Light<Lanes>& now, std::size_t lane) const
    {
        const std::vector<glm::dvec3> none(size_, glm::dvec3(0.0));
        std::vector<Means> sums(kSums, {none, none});
        for_each_span(area_of_part_.size(),
                      [&](std::size_t s, std::size_t first, std::size_t last) {
                          for (std::size_t p = first; p < last; ++p) {
                              const std::uint32_t n = solver_.numbers_.of_part(std::uint32_t(p));
                              const double area = double(area_of_part_[p]);
                              sums[s].change[solver_.group_[p]] +=
                                  area * glm::dvec3(now[n][lane] - before[n][lane]);
                              sums[s].light[solver_.group_[p]] += area * glm::dvec3(now[n][lane]);
                          }
                      });
        Means means{none, none};
        for (std::uint32_t g = 0; g < size_; ++g) {
            for (const Means& one : sums) {
                means.change[g] += one.change[g];
                means.light[g] += one.light[g];
            }
            means.change[g] /= std::max(area_[g], kMinArea);
            means.light[g] /= std::max(area_[g], kMinArea);
        }
        return means;
    }

    /// Calls visit(s, first, last) in parallel for the kSums spans of `count` elements.
    template <class Visit>
    static void for_each_span(std::size_t count, const Visit& visit)
    {
        parallel_for(kSums, 1, [&](std::size_t from, std::size_t to) {
            for (std::size_t s = from; s < to; ++s)
                visit(s, s * count / kSums, (s + 1) * count / kSums);
        });
    }

    /// Rows of K, scaled by the area of their group [m²]; those that no link leaves are empty.
    using Rows = std::vector<std::vector<glm::dvec3>>;  ///< [groups][groups or 0]

    /// 1 - K.
    void count_links(const System& system)
    {
        const std::vector<std::uint32_t>& order = solver_.work_.order;
        const std::size_t blocks = (order.size() + kLinkBlock - 1) / kLinkBlock;
        std::vector<Rows> sums(kSums, Rows(size_));
        for_each_span(blocks, [&](std::size_t s, std::size_t first, std::size_t last) {
            for (const std::vector<LinkBlock>& round : system.links.rounds)
                for (std::size_t b = first; b < last; ++b) {
                    LinkRows rows(round[b]);
                    const std::size_t end = std::min((b + 1) * kLinkBlock, order.size());
                    for (std::size_t o = b * kLinkBlock; o < end; ++o)
                        count_row(system, order[o], rows.next(solver_.parts_.is_cut(order[o])),
                                  sums[s]);
                }
        });
        for (const Rows& rows : sums)
            for (std::size_t a = 0; a < size_; ++a)
                for (std::size_t b = 0; b < rows[a].size(); ++b)
                    for (int c = 0; c < 3; ++c)
                        inverse_[c][a * size_ + b] -= rows[a][b][c] / std::max(area_[a], kMinArea);
        for (std::uint32_t g = 0; g < size_; ++g)
            for (int c = 0; c < 3; ++c)
                inverse_[c][std::size_t(g) * size_ + g] += 1.0;
    }

    void count_row(const System& system, std::uint32_t i, const LinkRow& row, Rows& sums) const
    {
        const SubLumels& parts = solver_.parts_;
        const std::vector<float>& rays = system.source.rays;
        const glm::dvec3 albedo(solver_.work_.lumels()[i].albedo);
        const auto add = [&](std::size_t k, LinkEnd to, const glm::dvec3& weight) {
            if (!solver_.numbers_.is_part(to.number()) ||
                rays[solver_.numbers_.part(to.number())] == 0.0f)
                return;
            const std::uint32_t p = parts.first(i) + row.leaves(parts, i, k);
            std::vector<glm::dvec3>& sum = sums[solver_.group_[p]];
            if (sum.empty())
                sum.assign(size_, glm::dvec3(0.0));
            sum[solver_.group_[solver_.numbers_.part(to.number())]] +=
                double(row.weight(k)) * double(area_of_part_[p]) / double(rays[p]) * albedo *
                weight;
        };
        for (std::size_t k = 0; k < row.ends.size(); ++k)
            add(k, row.ends[k], glm::dvec3(1.0));
        for (const NearLink& near : row.near)
            add(near.slot - row.first_slot, near.end, near.weight());
    }

    /// In place, by Gauss-Jordan elimination with diagonal pivots: 1 - K is diagonally dominant.
    void invert(std::vector<double>& m) const
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

    const LinkSolver& solver_;
    std::uint32_t size_;
    std::vector<double> inverse_[3];   ///< [groups][groups] (1 - K)⁻¹ of each channel
    std::vector<double> area_;         ///< [groups] [m²]
    std::vector<float> area_of_part_;  ///< [P] [m²]
};

LinkSolver::LinkSolver(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers)
    : work_(work),
      parts_(parts),
      numbers_(numbers),
      albedo_(parts.count()),
      group_(parts.count())
{
    for (std::size_t p = 0; p < albedo_.size(); ++p)
        albedo_[p] = work.lumels()[parts.lumel(p)].albedo;
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
        std::fill(group_.begin() + parts.first(i), group_.begin() + parts.end(i), at->second);
    }
    group_count_ = std::uint32_t(number.size());
}

/// A solve in progress: X of a few lamps at once, or of all light.
template <std::size_t Lanes>
class LinkSolver::Sweeps {
public:
    Sweeps(const LinkSolver& solver, const System& system, std::vector<glm::vec3>& received)
        : solver_(solver),
          system_(system),
          received_(received),
          parts_(solver.parts_.count()),
          sent_(solver.numbers_.count(), LaneLight<Lanes>{}),
          next_(sent_)
    {
        for (std::uint32_t p = 0; p < parts_; ++p)
            for (std::size_t lane = 0; lane < Lanes; ++lane)
                sent_[solver.numbers_.of_part(p)][lane] =
                    glm::vec4(solver.albedo_[p] * received[p * Lanes + lane], 0.0f);
        find_floors();
    }

    /// Runs until the residual is reached. Returns the last factor between changes.
    double run(double residual, double least_factor = 0.0)
    {
        std::optional<Groups> groups;
        double factor = 0.0;
        std::array<double, Lanes> before{};
        for (int sweep = 1; sweep <= kSweepLimit; ++sweep) {
            const Change<Lanes> change = sweep_all();
            bool is_done = true, is_slow = false;
            for (std::size_t lane = 0; lane < Lanes; ++lane) {
                const double size = change.size(lane);
                // Changes that shrink by a factor q leave q / (1 - q) of the last as residual. The
                // first change does not: it is all light in the first round, and noise of new rays
                // in later ones.
                if (!groups)
                    factor = size == 0.0 ? 0.0
                                         : std::clamp(before[lane] > 0.0 ? size / before[lane]
                                                                         : kSlowestSweep,
                                                      least_factor, kSlowestSweep);
                const double to_come = groups && size > 0.0
                                           ? size + groups->correct(sent_, next_, lane)
                                           : size * factor / (1.0 - factor);
                before[lane] = size;
                is_slow = is_slow || to_come * std::pow(factor, kWorthGroups) > residual;
                is_done = is_done && (size == 0.0 || (sweep > kFirstSweeps && to_come < residual));
            }
            sent_.swap(next_);
            if (is_done)
                break;
            if (sweep == 1)
                find_floors();
            if (sweep >= kPlainSweeps && is_slow && !groups)
                groups.emplace(solver_, system_);
        }
        return factor;
    }

    void run_once() { sweep_all(); }

private:
    void find_floors()
    {
        for (std::size_t lane = 0; lane < Lanes; ++lane)
            floor_[lane] = kDarkestCounted * mean_of(sent_, lane, parts_);
    }

    Change<Lanes> sweep_all()
    {
        const std::size_t blocks = (solver_.work_.order.size() + kLinkBlock - 1) / kLinkBlock;
        std::vector<Change<Lanes>> changes(blocks);
        parallel_for(blocks, kBlocksPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b)
                changes[b] = sweep_block(b);
        });
        Change<Lanes> all;
        for (const Change<Lanes>& change : changes)
            all.add(change);
        return all;
    }

    LaneLight<Lanes> source(std::uint32_t part) const
    {
        LaneLight<Lanes> light;
        for (std::size_t lane = 0; lane < Lanes; ++lane)
            light[lane] = system_.source.light[part * Lanes + lane];
        return light;
    }

    /// Computes X of a block's sub-lumels from the light that all send, and the light they then
    /// send.
    Change<Lanes> sweep_block(std::size_t b)
    {
        Change<Lanes> change;
        const std::vector<std::uint32_t>& order = solver_.work_.order;
        const SubLumels& parts = solver_.parts_;
        std::vector<LinkRows> rounds;
        for (const std::vector<LinkBlock>& round : system_.links.rounds)
            rounds.emplace_back(round[b]);
        const std::size_t end = std::min((b + 1) * kLinkBlock, order.size());
        for (std::size_t o = b * kLinkBlock; o < end; ++o) {
            const std::uint32_t i = order[o], first = parts.first(i), last = parts.end(i);
            std::array<LaneLight<Lanes>, kMaxParts> sums;
            if (parts.is_cut(i)) {
                for (std::uint32_t p = first; p < last; ++p)
                    sums[p - first] = source(p);
                for (LinkRows& rows : rounds)
                    add_row<Lanes>(rows.next(true), parts, i, sent_, sums);
            } else {
                LaneLight<Lanes> sum = source(first);
                for (LinkRows& rows : rounds)
                    sum = sum_of_row<Lanes>(rows.next(false), sent_, sum);
                sums[0] = sum;
            }
            for (std::uint32_t p = first; p < last; ++p)
                receive(p, sums[p - first], change);
        }
        return change;
    }

    void receive(std::uint32_t p, const LaneLight<Lanes>& sum, Change<Lanes>& change)
    {
        // Links to one without rays do not count: that of its lumel's other parts would leak.
        const float rays = system_.source.rays[p];
        const std::uint32_t n = solver_.numbers_.of_part(p);
        for (std::size_t lane = 0; lane < Lanes; ++lane) {
            glm::vec3& received = received_[p * Lanes + lane];
            received = rays > 0.0f ? glm::vec3(sum[lane]) / rays : glm::vec3(0.0f);
            next_[n][lane] = glm::vec4(solver_.albedo_[p] * received, 0.0f);
            change.add(lane, sent_[n][lane], next_[n][lane], floor_[lane]);
        }
    }

    const LinkSolver& solver_;
    const System& system_;
    std::vector<glm::vec3>& received_;
    const std::size_t parts_;
    Light<Lanes> sent_, next_;
    std::array<double, Lanes> floor_{};
};

double LinkSolver::solve(const LinkTable& links, const SourceTerm& source, double residual,
                         std::vector<glm::vec3>& received, double least_factor) const
{
    received.resize(parts_.count(), glm::vec3(0.0f));
    const System system{links, source};
    return Sweeps<1>(*this, system, received).run(residual, least_factor);
}

void LinkSolver::solve_lamps(const LinkTable& links, const SourceTerm& source, double residual,
                             std::vector<glm::vec3>& received) const
{
    received.assign(parts_.count() * kLampLanes, glm::vec3(0.0f));
    const System system{links, source};
    Sweeps<kLampLanes>(*this, system, received).run(residual);
}

void LinkSolver::gather_lamps(const LinkTable& links, const SourceTerm& source,
                              std::vector<glm::vec3>& received) const
{
    const System system{links, source};
    Sweeps<kLampLanes>(*this, system, received).run_once();
}

}  // namespace lumel
