// DirectEstimator's passes: few rays of all lumels, many of those that need them, then more where
// the variance is largest.

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/core/luminance.h"
#include "base/core/parallel.h"
#include "base/ranks/rank_blocks.h"
#include "links/direct/deviation.h"
#include "links/direct/direct.h"

namespace lumel {
namespace {

/// Blocks that each rank traces per step.
constexpr std::size_t kBlocksPerStep = 64;
/// Neighbours on each side in the order of lumels that are compared for the sources they see.
constexpr std::size_t kComparedNeighbours = 4;
/// Passes must reduce the variance to this fraction: those that gain less are not worth their rays.
constexpr double kMinGain = 0.9;
/// Passes with less growth are skipped.
constexpr double kMinTimes = 1.41;
/// Bisection steps for the number of rays that a variance needs, and the search range beyond the
/// point where the most uncertain lumel has the maximum number of rays.
constexpr int kSearchSteps = 24;
constexpr double kWidestSearch = 1e3;
/// Halves are uncertain if they differ by more than kUncertain × their mean, and by more than
/// kUncertainOfAll × the mean of all lumels.
constexpr double kUncertain = 0.02, kUncertainOfAll = 0.01;

}  // namespace

bool DirectEstimator::step()
{
    const std::vector<std::uint32_t>& list = first_pass_ ? work_.order : many_;
    if (first_pass_ && work_.sources.count() == 0)
        return false;
    if (!first_pass_ && done_ == blocks_.size())
        return false;  // no pass has begun since the last
    const std::size_t last_block =
        std::min(done_ + kBlocksPerStep * count_of(work_.ranks), blocks_.size());
    const std::size_t grain = work_.caster().batch() / (kBlock * 2 * kFewRays);
    parallel_for_own(work_.ranks, done_, last_block, grain,
                     [&](std::size_t first, std::size_t last) { find(list, first, last); });
    share(list, done_, last_block);
    done_ = last_block;
    if (done_ < blocks_.size())
        return true;

    // End of the pass.
    if (first_pass_)
        mark_uncertain_hidden();
    keep_cells();
    const bool more = first_pass_ && !many_.empty();
    first_pass_ = false;
    if (more)
        begin_pass();
    return more;
}

void DirectEstimator::begin_pass()
{
    blocks_.assign((many_.size() + kBlock - 1) / kBlock, {});
    done_ = 0;
}

/// Number of rays that lumel i should add if `rays` were optimal.
std::uint32_t DirectEstimator::wanted(std::uint32_t i, double rays) const
{
    const std::uint32_t taken = taken_[i];
    if (!(rays > kMinTimes * double(std::max(taken, kFewRays))))
        return 0;
    const double doubled = std::round(std::log2(std::max(rays / double(kManyRays), 1.0)));
    const std::uint32_t most = std::min(std::max(taken, kManyRays) * kMaxTimes, kMaxShadowRays);
    const auto all = std::uint32_t(std::min(std::exp2(doubled) * double(kManyRays), double(most)));
    return all > taken ? all - taken : 0;
}

bool DirectEstimator::refine(double share, std::uint64_t most, const std::vector<double>& weight)
{
    // The variance of one ray is about the lumel's variance × its rays. The sum of variances is
    // minimal if rays are proportional to deviations.
    const auto rays_of = [&](std::uint32_t i) { return double(std::max(taken_[i], kFewRays)); };
    std::vector<double> variance(work_.order.size()), square(work_.order.size());
    double now = 0.0;
    for (const std::uint32_t i : work_.order) {
        const glm::vec3 apart = half_[0][i] - half_[1][i];
        now += variance[i] = weight[i] * double(glm::dot(apart, apart));
        square[i] = variance[i] * rays_of(i);
    }
    const std::vector<double> deviation =
        deviation_nearby(square, work_.scene.lumels, work_.order, kDirectReach, 1.0);
    const double widest = *std::max_element(deviation.begin(), deviation.end());
    double left = 0.0;  // of the scale tried last
    const auto enough = [&](double scale) {
        left = 0.0;
        std::uint64_t rays = 0;
        for (const std::uint32_t i : work_.order) {
            if (work_.is_buried(i))
                continue;
            const std::uint32_t more = wanted(i, scale * deviation[i]);
            rays += 2 * std::uint64_t(more);
            left += more > 0 ? variance[i] * rays_of(i) / double(taken_[i] + more) : variance[i];
        }
        return rays >= most || left <= share * now;
    };
    if (!(widest > 0.0))
        return false;
    double low = double(kFewRays) / widest, high = kWidestSearch * double(kMaxShadowRays) / widest;
    for (int step = 0; step < kSearchSteps; ++step) {
        const double middle = std::sqrt(low * high);
        (enough(middle) ? high : low) = middle;
    }
    enough(high);
    if (left > kMinGain * now)
        return false;
    for (const std::uint32_t i : work_.order)
        more_[i] = wanted(i, high * deviation[i]);
    return begin_pass_of_many();
}

std::vector<std::uint8_t> DirectEstimator::levels() const
{
    std::vector<std::uint8_t> levels(work_.order.size(), 0);
    for (const std::uint32_t i : many_)
        levels[i] = std::uint8_t(std::bit_width((taken_[i] + more_[i]) / kManyRays));
    return levels;
}

bool DirectEstimator::refine_to(const std::vector<std::uint8_t>& levels)
{
    if (first_pass_)  // as long as there are no sources
        return false;
    for (const std::uint32_t i : work_.order) {
        const std::uint32_t all = levels[i] > 0 ? kManyRays << (levels[i] - 1) : 0;
        more_[i] = all > taken_[i] ? all - taken_[i] : 0;
    }
    return begin_pass_of_many();
}

/// Begins a pass of the lumels that it adds rays to. Returns false if there are none.
bool DirectEstimator::begin_pass_of_many()
{
    many_.clear();
    for (const std::uint32_t i : work_.order)
        if (more_[i] > 0 && !work_.is_buried(i))
            many_.push_back(i);
    if (many_.empty())
        return false;
    begin_pass();
    return true;
}

double DirectEstimator::fraction() const
{
    // Few rays, then many: each pass is about half of the work.
    const double part = blocks_.empty() ? 1.0 : double(done_) / double(blocks_.size());
    return first_pass_ ? 0.5 * part : 0.5 + 0.5 * part;
}

double DirectEstimator::mean_of_all() const
{
    double mean = 0.0;
    for (std::size_t i = 0; i < half_[0].size(); ++i)
        mean += luminance(this->mean(i));
    return mean / double(std::max<std::size_t>(half_[0].size(), 1));
}

/// True if the halves differ significantly.
bool DirectEstimator::differs(std::size_t i, double mean) const
{
    const double apart = std::abs(luminance(half_[0][i]) - luminance(half_[1][i]));
    return apart > kUncertain * luminance(this->mean(i)) && apart > kUncertainOfAll * mean;
}

/// Marks lumels that see part of a source, whose halves differ, or that see other sources than a
/// neighbour on their chart: few rays miss thin shadows.
void DirectEstimator::mark_uncertain_hidden()
{
    const std::vector<std::uint32_t> by_side = lumels_by_side(work_.scene.lumels);
    const int width = work_.scene.lumels.width, height = work_.scene.lumels.height;
    std::vector<char> needs = uncertain_;
    const double mean = mean_of_all();
    for (std::size_t i = 0; i < needs.size(); ++i)
        if (differs(i, mean))
            needs[i] = 1;
    parallel_for(work_.lumels().size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Lumel& lumel = work_.lumels()[i];
            const int x = int(lumel.texel) % width, y = int(lumel.texel) / width;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    if (x + dx < 0 || x + dx >= width || y + dy < 0 || y + dy >= height)
                        continue;
                    const std::size_t texel =
                        std::size_t(y + dy) * std::size_t(width) + std::size_t(x + dx);
                    const std::uint32_t other =
                        by_side[2 * texel + (lumel.flags & kLumelBack ? 1 : 0)];
                    if (other == kNoLumel || work_.lumels()[other].chart != lumel.chart)
                        continue;
                    if (uncertain_[other] || seen_[other] != seen_[i])
                        needs[i] = 1;
                }
        }
    });
    // Charts can be small: also compares neighbours in space, which the order approximates.
    for (std::size_t o = 0; o < work_.order.size(); ++o)
        for (std::size_t n = o + 1; n < std::min(o + 1 + kComparedNeighbours, work_.order.size());
             ++n) {
            const std::uint32_t i = work_.order[o], j = work_.order[n];
            if (uncertain_[i] || uncertain_[j] || seen_[i] != seen_[j])
                needs[i] = needs[j] = 1;
        }
    for (const std::uint32_t i : work_.order)
        if (needs[i] && !work_.is_buried(i)) {
            many_.push_back(i);
            more_[i] = kManyRays;
        }
}

}  // namespace lumel
