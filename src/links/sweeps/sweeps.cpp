#include "links/sweeps/sweeps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/core/error.h"
#include "base/core/parallel.h"
#include "links/kept/link_rows.h"
#include "links/sweeps/light_change.h"

namespace lumel {
namespace {

/// Sweeps before the factor between changes is used.
constexpr int kFirstSweeps = 2;
/// Sweeps before levels are corrected, and those that would have to follow: the first corrections
/// raise the change where groups hold cavities of their own light, which takes about as many
/// sweeps.
constexpr int kPlainSweeps = 10, kWorthGroups = 12;
/// For the residual, sub-lumels darker than this × the mean count as that bright.
constexpr double kDarkestCounted = 1e-4;
constexpr int kSweepLimit = 2000;
/// Blocks, and spans of kGroup sub-lumels, per task.
constexpr std::size_t kBlocksPerTask = 4, kSpansPerTask = 64;
/// Minimum assumed convergence: changes shrink at least by this factor.
constexpr double kSlowestSweep = 1.0 - 1e-6;

template <std::size_t Lanes>
using Light = std::vector<LaneLight<Lanes>>;

float darkest_counted(double light, std::size_t parts)
{
    return float(kDarkestCounted * light / double(std::max<std::size_t>(parts, 1)));
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

/// Adds the light along the rays of a row to the sub-lumels of lumel i, which has hidden points.
template <std::size_t Lanes>
void add_row(const LinkRow& row, const SubLumels& parts, std::size_t i, const Light<Lanes>& sent,
             std::array<LaneLight<Lanes>, kMaxParts>& sums)
{
    for (std::size_t k = 0; k < row.ends.size(); ++k)
        add(sums[row.leaves(parts, i, k)], row.weight(k), sent[row.ends[k].number()]);
    for (const NearLink& near : row.near)
        add_near(sums[row.leaves(parts, i, near.slot - row.first_slot)], row, near, sent);
}

/// `sum` with the light along the rays of a row, of a lumel without hidden points.
template <std::size_t Lanes>
LaneLight<Lanes> sum_of_row(const LinkRow& row, const Light<Lanes>& sent, LaneLight<Lanes> sum)
{
    if (row.weights)
        for (std::size_t k = 0; k < row.ends.size(); ++k)
            add(sum, row.weight(k), sent[row.ends[k].number()]);
    else
        for (const LinkEnd end : row.ends)
            add(sum, sent[end.number()]);
    for (const NearLink& near : row.near)
        add_near(sum, row, near, sent);
    return sum;
}

}  // namespace

LinkSolver::LinkSolver(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers)
    : work_(work),
      parts_(parts),
      numbers_(numbers),
      groups_(work, parts),
      albedo_(parts.count())
{
    for (std::size_t p = 0; p < albedo_.size(); ++p)
        albedo_[p] = work.lumels()[parts.lumel(p)].albedo;
}

/// Sweeps until the residual is reached.
template <std::size_t Lanes, class Sweeps>
LinkSolver::Swept LinkSolver::run(Sweeps& sweeps, const System& system, double residual,
                                  double least_factor) const
{
    std::optional<LevelCorrection> levels;
    Swept swept;
    double& factor = swept.factor;
    std::array<double, Lanes> before{};
    std::array<float, Lanes> darkest{};
    for (std::size_t lane = 0; lane < Lanes; ++lane)
        darkest[lane] = darkest_counted(sweeps.light(lane), parts_.count());
    for (int sweep = 1; sweep <= kSweepLimit; ++sweep) {
        swept.sweeps = sweep;
        const std::array<LightChange, Lanes> change = sweeps.sweep(darkest);
        bool is_done = true, is_slow = false;
        for (std::size_t lane = 0; lane < Lanes; ++lane) {
            const double size = change[lane].size();
            if (!std::isfinite(size))
                throw Error(ErrorKind::input, "light",
                            "grows without bound over guided rays; send them evenly (--guide off)");
            // Changes that shrink by a factor q leave q / (1 - q) of the last as residual. The
            // first change does not: it is all light in the first round, and noise of new rays
            // in later ones.
            if (!levels)
                factor = size == 0.0
                             ? 0.0
                             : std::clamp(before[lane] > 0.0 ? size / before[lane] : kSlowestSweep,
                                          least_factor, kSlowestSweep);
            const double to_come = levels && size > 0.0 ? size + sweeps.correct(*levels, lane)
                                                        : size * factor / (1.0 - factor);
            before[lane] = size;
            is_slow = is_slow || to_come * std::pow(factor, kWorthGroups) > residual;
            is_done = is_done && (size == 0.0 || (sweep > kFirstSweeps && to_come < residual));
            if (sweep == 1)
                darkest[lane] = darkest_counted(change[lane].light, parts_.count());
        }
        sweeps.advance();
        if (is_done)
            break;
        if (sweep >= kPlainSweeps && is_slow && !levels)
            levels.emplace(groups_, work_, parts_, numbers_, system.links, system.source.rays);
    }
    return swept;
}

/// Sweeps on the CPU, of a few lamps at once or of all light.
template <std::size_t Lanes>
class LinkSolver::HostSweeps {
public:
    HostSweeps(const LinkSolver& solver, const System& system, std::vector<glm::vec3>& received)
        : solver_(solver),
          system_(system),
          received_(received),
          parts_(solver.parts_.count()),
          sent_(solver.numbers_.count(), LaneLight<Lanes>{}),
          next_(sent_)
    {
        for (std::uint32_t p = 0; p < parts_; ++p)
            for (std::size_t lane = 0; lane < Lanes; ++lane)
                sent_[number(p)][lane] =
                    glm::vec4(radiosity(solver.albedo_[p], received[p * Lanes + lane]), 0.0f);
    }

    /// Sent by all, summed over channels.
    double light(std::size_t lane) const
    {
        double sum = 0.0;
        for (const LaneLight<Lanes>& light : sent_)
            sum += sum_of_channels(light[lane]);
        return sum;
    }

    std::array<LightChange, Lanes> sweep(const std::array<float, Lanes>& darkest)
    {
        sweep_all();
        const std::size_t spans = (parts_ + kGroup - 1) / kGroup;
        std::vector<std::array<SweepSums, Lanes>> sums(spans);
        parallel_for(spans, kSpansPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t s = first; s < last; ++s)
                for (std::size_t lane = 0; lane < Lanes; ++lane)
                    sums[s][lane] = sum_span(s * kGroup, lane, darkest[lane]);
        });
        std::array<LightChange, Lanes> change;
        for (const std::array<SweepSums, Lanes>& span : sums)
            for (std::size_t lane = 0; lane < Lanes; ++lane)
                change[lane].add(span[lane]);
        return change;
    }

    /// X from the light that all send, and the light that they then send.
    void sweep_all()
    {
        Ranks* const ranks = solver_.work_.ranks;
        const std::size_t blocks = blocks_of(solver_.work_);
        parallel_for_own(ranks, 0, blocks, kBlocksPerTask,
                         [&](std::size_t first, std::size_t last) {
                             for (std::size_t b = first; b < last; ++b)
                                 sweep_block(b);
                         });
        share_bytes(ranks, 0, blocks, [&](std::size_t b) {
            return std::as_writable_bytes(std::span(received_).subspan(
                parts_of(b).first * Lanes, (parts_of(b).last - parts_of(b).first) * Lanes));
        });
        parallel_for_others(
            ranks, 0, blocks, kBlocksPerTask, [&](std::size_t first, std::size_t last) {
                for (std::size_t p = parts_of(first).first; p < parts_of(last - 1).last; ++p)
                    for (std::size_t lane = 0; lane < Lanes; ++lane)
                        send(std::uint32_t(p), lane);
            });
    }

    /// Corrects the light after a sweep. Returns the residual.
    double correct(const LevelCorrection& levels, std::size_t lane)
    {
        const std::vector<GroupSpan>& spans = levels.spans();
        std::vector<GroupSums> sums(spans.size());
        parallel_for(spans.size(), kSpansPerTask, [&](std::size_t first, std::size_t last) {
            for (std::size_t s = first; s < last; ++s)
                sums[s] = sum_group_span(levels, spans[s], lane);
        });
        const LevelCorrection::Found found = levels.find(sums);
        parallel_for(parts_, kSpansPerTask * kGroup, [&](std::size_t first, std::size_t last) {
            for (std::size_t p = first; p < last; ++p)
                next_[number(p)][lane] *= found.factors[levels.groups().of_part[p]];
        });
        return found.residual;
    }

    void advance() { sent_.swap(next_); }

private:
    std::uint32_t number(std::size_t part) const
    {
        return solver_.numbers_.of_part(std::uint32_t(part));
    }

    SweepSums sum_span(std::size_t first, std::size_t lane, float darkest) const
    {
        SweepSums sums{};
        const std::size_t last = std::min(first + kGroup, parts_);
        for (std::uint32_t n = number(first); n < number(last); ++n)
            sums = plus(sums,
                        sweep_sums(glm::vec3(sent_[n][lane]), glm::vec3(next_[n][lane]), darkest));
        return sums;
    }

    GroupSums sum_group_span(const LevelCorrection& levels, const GroupSpan& span,
                             std::size_t lane) const
    {
        GroupSums sums{};
        for (std::uint32_t m = span.first; m < span.last; ++m) {
            const std::uint32_t p = levels.members()[m], n = number(p);
            sums = plus(sums, group_sums(glm::vec3(sent_[n][lane]), glm::vec3(next_[n][lane]),
                                         levels.areas()[p]));
        }
        return sums;
    }

    /// The sub-lumels of a block, which are numbered in the order of lumels.
    PartRange parts_of(std::size_t b) const
    {
        return lumel::parts_of(solver_.work_, solver_.parts_, b);
    }

    LaneLight<Lanes> source(std::uint32_t part) const
    {
        LaneLight<Lanes> light;
        for (std::size_t lane = 0; lane < Lanes; ++lane)
            light[lane] = system_.source.light[part * Lanes + lane];
        return light;
    }

    void sweep_block(std::size_t b)
    {
        const SubLumels& parts = solver_.parts_;
        std::vector<LinkRows> rounds;
        for (const std::vector<LinkBlock>& round : system_.links.rounds)
            rounds.emplace_back(round[b]);
        for (const std::uint32_t i : lumels_of(solver_.work_, b)) {
            const std::uint32_t first = parts.first(i), last = parts.end(i);
            std::array<LaneLight<Lanes>, kMaxParts> sums;
            if (parts.has_hidden(i)) {
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
                receive(p, sums[p - first]);
        }
    }

    void receive(std::uint32_t p, const LaneLight<Lanes>& sum)
    {
        const float share = system_.source.share_of_ray(p);
        for (std::size_t lane = 0; lane < Lanes; ++lane) {
            received_[p * Lanes + lane] = mean_light(glm::vec3(sum[lane]), share);
            send(p, lane);
        }
    }

    /// The light that a sub-lumel sends once it has received the present one.
    void send(std::uint32_t p, std::size_t lane)
    {
        next_[number(p)][lane] =
            glm::vec4(radiosity(solver_.albedo_[p], received_[p * Lanes + lane]), 0.0f);
    }

    const LinkSolver& solver_;
    const System& system_;
    std::vector<glm::vec3>& received_;
    const std::size_t parts_;
    Light<Lanes> sent_, next_;
};

LinkSolver::Swept LinkSolver::solve(const LinkTable& links, const SourceTerm& source,
                                    double residual, std::vector<glm::vec3>& received,
                                    double least_factor) const
{
    received.resize(parts_.count(), glm::vec3(0.0f));
    const System system{links, source};
    HostSweeps<1> sweeps(*this, system, received);
    return run<1>(sweeps, system, residual, least_factor);
}

LinkSolver::Swept LinkSolver::solve_on(DeviceSweeps& device, const DeviceLinks& copy,
                                       const LinkTable& links, const SourceTerm& source,
                                       double residual, std::vector<glm::vec3>& received,
                                       double least_factor) const
{
    device.begin(copy, source, received);
    const Swept swept = run<1>(device, {links, source}, residual, least_factor);
    received = device.received();
    return swept;
}

void LinkSolver::solve_lamps(const LinkTable& links, const SourceTerm& source, double residual,
                             std::vector<glm::vec3>& received) const
{
    received.assign(parts_.count() * kLampLanes, glm::vec3(0.0f));
    const System system{links, source};
    HostSweeps<kLampLanes> sweeps(*this, system, received);
    run<kLampLanes>(sweeps, system, residual, 0.0);
}

void LinkSolver::gather_lamps(const LinkTable& links, const SourceTerm& source,
                              std::vector<glm::vec3>& received) const
{
    HostSweeps<kLampLanes>(*this, {links, source}, received).sweep_all();
}

}  // namespace lumel
