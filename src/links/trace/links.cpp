// Radiosity over links. The irradiance of a lumel is direct light D, from shadow rays to light
// sources, plus light along cosine-distributed rays. Each of these is traced once. The sub-lumel
// and the cell that it hits are stored, a link of four bytes, and X = C + K ρ X, with C the light
// of sources at the ends of links, is solved over the links, sweep by sweep, for all bounces at
// once (links/trace/sweeps.cpp). The cost grows linearly with the number of lumels.
//
// Three solutions have their own links, and direct light has two halves. The result is the mean of
// the solutions, filtered over charts. The noise of different solutions is independent: the
// variance of filtered A', B' is in A' - B', and the squared filter bias is the mean of (A' - A)(B'
// - B). All have the same gains, from averages over many lumels. See links/filter/pyramid.h,
// links/filter/mean.h.
//
// Where light changes within a lumel, direct light is stored for a grid of cells, and geometry cuts
// the lumel into sub-lumels, each with its own X (atlas/cells/cells.h).

#include "links/trace/links.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "atlas/cells/order.h"
#include "base/core/luminance.h"
#include "base/core/state_bytes.h"
#include "base/core/usage.h"
#include "links/direct/deviation.h"
#include "links/filter/visible_noise.h"
#include "links/trace/adapted_light.h"
#include "links/trace/link_casters.h"
#include "links/trace/shared_directions.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Rays per lumel in each solution of the first round; powers of two stratify best.
constexpr std::uint32_t kFirstRays = 8;
/// Minimum and maximum rays of a later round, relative to the rays so far.
constexpr double kMinAdded = 0.4, kMaxAdded = 3.0;
/// Rays allocated by deviation reduce the variance like 1 / kAdaptiveGain as many uniform ones.
constexpr double kAdaptiveGain = 0.6;
/// Rays per lumel in all solutions for an estimated error of 5 %: 24 in Cornell's box, 34 in
/// Sponza, 74 in the town of scenes/town.py.
constexpr double kLikelyRays = 64.0;
/// [bytes] of a link, and of a lumel per round and solution: number of its links.
constexpr double kLinkBytes = sizeof(LinkEnd), kRowBytes = sizeof(std::uint16_t);
/// Fraction of lumels with direct light per cell: maximum seen.
constexpr double kVarying = 0.1;
/// Blocks of links per step, at the first round's number of rays.
constexpr std::size_t kBlocksPerStep = 128;
/// Blocks per step when rasterising, whose cost hardly grows with them: a million rays (200 MB).
constexpr std::size_t kBlocksPerDrawing = 512;
/// Refines direct light if its variance is this multiple of its target; at most to kMinDirect × the
/// present variance in one pass.
constexpr double kTooUncertain = 1.25, kMinDirect = 1.0 / 16.0;
/// Cost of a link relative to a shadow ray, sweeps and filter included.
constexpr double kCostOfLink = 1.5;
/// Variance of rays after a round that adds kMaxAdded, relative to that before.
constexpr double kNextRound = 1.0 / (1.0 + kMaxAdded);
/// Bounds on the fraction of the target variance that direct light may have.
constexpr double kMinShare = 0.1, kMaxShare = 0.6;
/// Fraction of the first round that direct light takes, for the progress bar only.
constexpr double kDirectOfRound = 0.5;
/// What sweeps may leave out, relative to each sub-lumel's light: at least this, and this fraction
/// of a target error.
constexpr double kResidual = 1e-3, kResidualOfTarget = 0.05;
/// Minimum mean albedo of rooms whose level is balanced.
constexpr double kBrightRoom = 0.95;
/// Lumels below this fraction of the mean are dark.
constexpr double kDark = 1.0 / 3.0;

constexpr double kShareOfFree = 0.5;

/// Adds the elapsed time to a stage [ms].
class Stopwatch {
public:
    explicit Stopwatch(double& sum) : sum_(sum) {}
    ~Stopwatch()
    {
        sum_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
                    .count();
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    double& sum_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::uint64_t free_bytes_for_links()
{
    return std::uint64_t(kShareOfFree * double(available_memory_bytes()));
}

LinkRadiosity::LinkRadiosity(const gpu::Device& device, const SolveScene& scene,
                             const LinksOptions& options, const SolveLimits& limits, Parts parts)
    : LinkRadiosity(scene, casters_for(device, scene.rays, options.rays), options, limits, parts)
{
}

LinkRadiosity::LinkRadiosity(const SolveScene& scene, const LinksOptions& options,
                             const SolveLimits& limits, Parts parts)
    : LinkRadiosity(scene, {.rays = cast_on_host(scene.rays)}, options, limits, parts)
{
}

LinkRadiosity::LinkRadiosity(const SolveScene& scene, LinkWork::Casters casters,
                             const LinksOptions& options, const SolveLimits& limits, Parts parts)
    : options_(options),
      target_error_(limits.target_error),
      target_dark_error_(limits.target_dark_error),
      target_eye_error_(limits.target_eye_error),
      most_shots_(limits.max_shots),
      most_bytes_(limits.max_bytes),
      parts_wanted_(parts),
      work_(scene, std::move(casters), options.rule, order_in_space)
{
}

LinkRadiosity::~LinkRadiosity() = default;

std::uint64_t LinkRadiosity::first_bytes(std::size_t lumels, std::uint32_t even_rays)
{
    const double rays = even_rays > 0 ? double(even_rays) : double(kSolutions * kFirstRays);
    return std::uint64_t(double(lumels) * (rays * kLinkBytes + kSolutions * kRowBytes));
}

std::uint64_t LinkRadiosity::likely_bytes(std::size_t lumels, std::uint64_t shots)
{
    constexpr double kFirst = kSolutions * kFirstRays;
    const double rays = shots > 0 ? std::min(double(shots), kLikelyRays) : kLikelyRays;
    double rounds = 1.0;
    for (double traced = kFirst; traced < rays; traced *= 1.0 + kMinAdded)
        ++rounds;
    return std::uint64_t(double(lumels) * (rays * kLinkBytes + rounds * kSolutions * kRowBytes));
}

std::uint64_t LinkRadiosity::host_bytes(std::size_t lumels, std::size_t pieces, std::size_t texels)
{
    constexpr std::size_t kOfSources = 2 * sizeof(glm::vec3) + sizeof(std::uint32_t);
    constexpr std::size_t kOfMean = 2 * sizeof(glm::vec3) + sizeof(glm::vec2) + 2 * sizeof(float);
    constexpr std::size_t kOfOrder = sizeof(std::uint32_t), kOfGroups = sizeof(std::uint32_t);
    const std::size_t of_parts =
        kSolutions * (kOfSources + sizeof(glm::vec3)) + kOfGroups + sizeof(glm::vec3);
    const std::size_t of_lumels =
        sizeof(WorldLumel) + kOfOrder + 2 * kOfMean + sizeof(std::uint16_t);
    const auto varying = std::size_t(kVarying * double(lumels));
    return lumels * (of_lumels + of_parts) + pieces * (sizeof(Piece) + sizeof(Facet)) +
           Cells::bytes(lumels) + SubLumels::bytes(lumels, lumels) +
           DirectEstimator::bytes(lumels, varying) + NearLumels::bytes(texels) +
           ChartFilter::bytes(lumels, texels);
}

std::uint64_t LinkRadiosity::sweep_bytes(std::size_t lumels)
{
    const std::uint64_t sweep = lumels * 3 * sizeof(glm::vec4);
    const std::uint64_t mean = lumels * (kSolutions * sizeof(glm::vec3) + sizeof(float)) +
                               ChartFilter::working_bytes(lumels);
    return std::max(sweep, mean);
}

void LinkRadiosity::step()
{
    switch (stage_) {
    case Stage::begin: {
        const Stopwatch clock(times_["sub-lumels"]);
        cut();
        stage_ = Stage::direct;
        break;
    }
    case Stage::direct: {
        const Stopwatch clock(times_["direct light"]);
        if (direct_->step())
            break;
        if (state_.shots == 0) {
            begin_round();
        } else {
            estimate();
            go_on();
        }
        break;
    }
    case Stage::links: {
        const Stopwatch clock(times_["links"]);
        trace();
        if (traced_ == tracer_->blocks())
            stage_ = Stage::solve;
        break;
    }
    case Stage::solve: {
        const Stopwatch clock(times_["sweeps"]);
        end_round();
        break;
    }
    }
    ++state_.iterations;
    state_.begun = begun();
}

/// State that changes after the lumels are cut; the cut is repeated.
template <class Archive>
void LinkRadiosity::state(Archive& archive)
{
    archive(*direct_, direct_mean_.light, direct_mean_.noise, direct_mean_.wrong,
            direct_mean_.apart, direct_mean_.bend, round_, mean_rays_, means_, rays_, traced_,
            mean_.light, mean_.noise, mean_.wrong, mean_.apart, mean_.bend, mean_light_, adapted_,
            all_, dark_, eye_, state_, times_);
    for (std::size_t k = 0; k < kSolutions; ++k)
        archive(*links_[k], sources_[k].rays, received_[k]);
}

void LinkRadiosity::write_state(StateWriter& writer)
{
    writer(stage_);
    if (stage_ != Stage::begin)
        state(writer);
}

void LinkRadiosity::read_state(StateReader& reader)
{
    reader(stage_);
    if (stage_ == Stage::begin)
        return;
    cut();
    state(reader);
    state_.full = false;
    if (!is_consistent())
        reader.fail();
}

/// True if the state that was read is of these lumels and sub-lumels.
bool LinkRadiosity::is_consistent() const
{
    const std::size_t lumels = work_.order.size(), parts = parts_->count();
    const auto is = [](std::size_t size, std::size_t wanted) {
        return size == 0 || size == wanted;
    };
    const bool is_tracing = stage_ == Stage::links || stage_ == Stage::solve;
    const std::size_t traced = is_tracing ? traced_ : tracer_->blocks();
    bool fits = stage_ > Stage::begin && stage_ <= Stage::solve && direct_->fits() &&
                is(rays_.size(), lumels) && is(direct_mean_.light.size(), lumels) &&
                direct_mean_.noise.size() == direct_mean_.light.size() &&
                direct_mean_.wrong.size() == direct_mean_.light.size() &&
                direct_mean_.apart.size() == direct_mean_.light.size() &&
                direct_mean_.bend.size() == direct_mean_.light.size() &&
                is(mean_.light.size(), lumels) && is(mean_.noise.size(), lumels) &&
                is(mean_.wrong.size(), lumels) && is(mean_.apart.size(), lumels) &&
                is(mean_.bend.size(), lumels) && is(adapted_.size(), lumels) &&
                traced_ <= tracer_->blocks() && means_.size() == round_ &&
                (state_.shots > 0) == !mean_.light.empty() &&
                (!is_tracing || (mean_rays_ > 0.0 && rays_.size() == lumels)) &&
                (stage_ != Stage::solve || traced_ == tracer_->blocks());
    for (std::size_t k = 0; k < kSolutions; ++k)
        fits = fits && links_[k]->rounds.size() == round_ + (is_tracing ? 1 : 0) &&
               links_[k]->fits(work_.order, *parts_, *numbers_, traced) &&
               received_[k].size() >= (mean_.light.empty() ? 0 : parts) &&
               is(received_[k].size(), parts) &&
               sources_[k].rays.size() == (mean_.light.empty() ? 0 : parts);
    return fits;
}

/// Progress of the first round.
double LinkRadiosity::begun() const
{
    if (state_.shots > 0)
        return 1.0;
    if (stage_ == Stage::direct)
        return kDirectOfRound * direct_->fraction();
    return kDirectOfRound + (1.0 - kDirectOfRound) * double(traced_) / double(tracer_->blocks());
}

void LinkRadiosity::cut()
{
    if (stored_)
        changes_ = changes_since(*stored_, work_.scene, work_.world, options_.seed);
    parts_.emplace(work_.world, work_.cells, work_.scene.rays, work_.scene.lumels, work_.order,
                   PathSamples::hash(options_.seed, kPartStream));
    numbers_.emplace(work_.scene.scene.instances.size(), parts_->count());
    solver_.emplace(work_, *parts_, *numbers_);
    find_light();
}

/// Prepares direct light and links of the present sources.
void LinkRadiosity::find_light()
{
    direct_.emplace(work_, PathSamples::hash(options_.seed, kDirectStream), &*parts_);
    tracer_.emplace(work_, *parts_, *numbers_, *direct_, options_.seed);
    for (std::optional<LinkTable>& links : links_)
        links.emplace(parts_->count());
    sealed_.emplace(work_, *parts_, *numbers_);
}

/// Traces a step of the round's rays.
void LinkRadiosity::trace()
{
    const std::size_t blocks = work_.casters.bundles ? kBlocksPerDrawing : kBlocksPerStep;
    const std::size_t count =
        std::max(std::size_t(double(blocks * kFirstRays) / mean_rays_), std::size_t(1));
    const std::size_t last = std::min(traced_ + count, tracer_->blocks());
    const bool shares = shares_directions();
    for (std::uint32_t k = 0; k < kSolutions; ++k) {
        const std::uint32_t stream = kLinkStream + kSolutions * round_ + k;
        std::optional<SharedDirections> shared;
        if (shares)
            shared.emplace(
                mean_rays_,
                PathSamples::hash(PathSamples::hash(options_.seed, kSharedStream), stream));
        LinkTracer::Sending sending{rays_, stream, shared ? &*shared : nullptr};
        if (has_known_round())
            sending.known.emplace(
                LinkTracer::Known{changes_, stored_->rounds[round_], first_rays_, k});
        tracer_->trace(traced_, last, sending, *links_[k]);
    }
    traced_ = last;
}

bool LinkRadiosity::shares_directions() const
{
    if (stored_)
        return stored_->shared_directions != 0;
    return work_.casters.bundles || options_.shared_directions;
}

void LinkRadiosity::begin_links()
{
    traced_ = 0;
    stage_ = Stage::links;
    for (std::optional<LinkTable>& links : links_)
        links->rounds.emplace_back(tracer_->blocks());
}

/// Starts a round with the rays that the target error requires, within limits.
void LinkRadiosity::begin_round()
{
    if (has_known_round()) {
        begin_known_round();
        return;
    }
    mean_rays_ = state_.shots > 0         ? more_rays()
                 : options_.even_rays > 0 ? double(options_.even_rays) / double(kSolutions)
                                          : kFirstRays;
    const double fit = rays_that_fit();
    if (state_.shots > 0 && fit < kMinAdded * double(state_.shots) / double(kSolutions)) {
        state_.full = true;
        stage_ = Stage::direct;  // without work
        return;
    }
    if (options_.even_rays == 0)
        mean_rays_ = std::min(mean_rays_, std::max(fit, double(kFirstRays)));
    if (most_shots_ > state_.shots)
        mean_rays_ = std::min(mean_rays_, double(most_shots_ - state_.shots) / double(kSolutions));
    share_out_rays();
    if (state_.shots > 0)
        leave_sealed_space();
    filter_.reset();
    begin_links();
}

/// [P] 1 for sub-lumels that send light or receive some.
std::vector<char> LinkRadiosity::lit_parts() const
{
    std::vector<char> lit(parts_->count(), 0);
    for (std::uint32_t p = 0; p < lit.size(); ++p) {
        lit[p] = work_.lumels()[parts_->lumel(p)].emission != glm::vec3(0.0f);
        for (const std::vector<glm::vec3>& received : received_)
            lit[p] |= received[p] != glm::vec3(0.0f);
    }
    for (std::size_t i = 0; i < work_.lumels().size(); ++i)
        for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c)
            if (direct_->at(i, c) != glm::vec3(0.0f))
                lit[parts_->part(i, c)] = 1;
    return lit;
}

/// Lumels that no light can reach send no more rays: as long as no link, theirs or one to them,
/// joins them with light.
void LinkRadiosity::leave_sealed_space()
{
    const std::vector<char> lit = lit_parts();
    if (std::find(lit.begin(), lit.end(), 0) == lit.end())
        return;
    for (std::size_t k = 0; k < kSolutions; ++k)
        sealed_->join(*links_[k], k);
    const std::vector<char> sealed = sealed_->sealed(lit);
    for (std::size_t i = 0; i < sealed.size(); ++i)
        if (sealed[i])
            rays_[i] = 0;
}

/// Further rays per lumel and solution for the target error.
double LinkRadiosity::more_rays() const
{
    const double so_far = double(state_.shots) / double(kSolutions);
    double more = so_far;
    if (const std::vector<Wanted> all = wanted(); !all.empty()) {
        double ratio = 0.0;
        for (const Wanted& one : all) {
            const double square = one.error * one.error;
            const double left = square - std::min(one.now.direct, kMaxShare * square);
            ratio = std::max(ratio, one.now.rays / left);
        }
        more = std::clamp(kAdaptiveGain * so_far * (ratio - 1.0), kMinAdded * so_far,
                          kMaxAdded * so_far);
    }
    return std::min(more, double(kMaxLinks));
}

/// Further rays per lumel and solution that fit in memory.
double LinkRadiosity::rays_that_fit() const
{
    if (most_bytes_ == 0)
        return kMaxLinks;
    double taken = 0.0;
    for (const std::optional<LinkTable>& links : links_)
        taken += double(links->bytes());
    const double of_ray =
        state_.shots > 0 ? taken / double(state_.shots) : double(work_.order.size()) * kLinkBytes;
    const double rows = kSolutions * double(work_.order.size()) * kRowBytes;
    return std::max(double(most_bytes_) - taken - rows, 0.0) / (kSolutions * of_ray);
}

/// What sweeps leave out, relative to each sub-lumel's light: little beside the target errors.
double LinkRadiosity::sweep_residual() const
{
    double target = 0.0;
    for (const Wanted& one : wanted())
        target = target > 0.0 ? std::min(target, one.error) : one.error;
    return std::max(kResidual, kResidualOfTarget * target);
}

/// Solves for all bounces over the links of each solution.
void LinkRadiosity::solve()
{
    const ReflectedLight reflected(work_, *parts_, *numbers_, *direct_);
    for (std::size_t k = 0; k < kSolutions; ++k) {
        sources_[k] = find_source_term(work_, *parts_, *numbers_, reflected, *links_[k]);
        solver_->solve(*links_[k], sources_[k], sweep_residual(), received_[k]);
        balance(k);
    }
}

void LinkRadiosity::end_round()
{
    state_.shots += std::uint64_t(std::llround(double(kSolutions) * mean_rays_));
    means_.push_back(mean_rays_);
    ++round_;
    if (has_known_round()) {
        begin_known_round();
        return;
    }
    solve();
    combine();
    estimate();
    go_on();
}

/// In a bright closed room the overall level of the light is noisy, but the absorbed light is
/// known: it equals the direct light, Σ A (1 - ρ) (D + X) = Σ A D.
void LinkRadiosity::balance(std::size_t k)
{
    if (!sources_[k].is_closed)
        return;
    glm::dvec3 absorbed(0.0), reflected(0.0);
    double area = 0.0, albedo = 0.0;
    for (std::size_t i = 0; i < work_.lumels().size(); ++i) {
        const Lumel& lumel = work_.lumels()[i];
        if (lumel.flags & kLumelBuried)
            continue;
        const double a = double(lumel.area);
        absorbed += a * glm::dvec3((1.0f - lumel.albedo) * indirect(i, k));
        reflected += a * glm::dvec3(lumel.albedo * direct_->mean(i));
        area += a;
        albedo += a * double(lumel.albedo.r + lumel.albedo.g + lumel.albedo.b) / 3.0;
    }
    if (albedo < kBrightRoom * area)
        return;
    glm::vec3 factor(1.0f);
    for (int c = 0; c < 3; ++c)
        if (absorbed[c] > 0.0)
            factor[c] = float(reflected[c] / absorbed[c]);
    for (glm::vec3& light : received_[k])
        light *= factor;
}

/// Target errors, with current values.
std::vector<LinkRadiosity::Wanted> LinkRadiosity::wanted() const
{
    std::vector<Wanted> result;
    if (target_error_ > 0.0)
        result.push_back({target_error_, all_});
    if (target_dark_error_ > 0.0)
        result.push_back({target_dark_error_, dark_});
    if (target_eye_error_ > 0.0)
        result.push_back({target_eye_error_, eye_});
    return result;
}

/// Starts the next stage: refines direct light, or adds links.
void LinkRadiosity::go_on()
{
    const std::vector<Wanted> all = wanted();
    const bool reached = std::all_of(all.begin(), all.end(), [](const Wanted& one) {
        return one.now.rays + one.now.direct <= one.error * one.error;
    });
    const bool is_even = options_.even_rays > 0;
    if ((reached && !all.empty()) || is_even) {
        state_.ended = is_even;
        stage_ = Stage::direct;  // without work
        return;
    }
    if (refine_direct())
        stage_ = Stage::direct;
    else if (stored_ && then_ == Then::end)
        state_.ended = true;
    else
        begin_round();
}

/// Fraction of the target variance for direct light. For variances that fall as 1 / rays, the total
/// cost is minimal if they are in proportion to √(variance × cost).
double LinkRadiosity::share_of_direct(const Errors& now) const
{
    const double of_rays = kCostOfLink * now.rays * double(state_.shots * work_.order.size());
    const double of_direct = now.direct * double(direct_->rays());
    const double root = std::sqrt(of_direct), sum = root + std::sqrt(of_rays);
    return sum > 0.0 ? std::clamp(root / sum, kMinShare, kMaxShare) : kMaxShare;
}

/// Schedules refinement of direct light if its noise dominates: beside that of the rays after the
/// next round, as long as they are above the target.
bool LinkRadiosity::refine_direct()
{
    double share = 1.0;
    const auto cut = [&](double square, const Errors& now) {
        const double most = share_of_direct(now) * std::max(square, kNextRound * now.rays);
        if (now.direct > kTooUncertain * most)
            share = std::min(share, std::max(most / now.direct, kMinDirect));
    };
    const std::vector<Wanted> all = wanted();
    for (const Wanted& one : all)
        cut(one.error * one.error, one.now);
    if (all.empty())
        cut(all_.rays + all_.direct, all_);
    if (!(share < 1.0))
        return false;
    // By the variance that the filter leaves, as rays are allocated.
    std::vector<double> weight = weights();
    if (const ChartFilter* const by = filter()) {
        const Mean plain = plain_mean(direct_->half(0), direct_->half(1));
        const std::vector<double> left =
            by->variance_left({plain.noise.begin(), plain.noise.end()},
                              {direct_mean_.noise.begin(), direct_mean_.noise.end()});
        for (std::size_t i = 0; i < weight.size(); ++i)
            weight[i] *= left[i];
    }
    return direct_->refine(share, state_.shots * work_.order.size(), weight);
}

/// Irradiance by rays at a lumel in one solution, of the requested parts of light [lx].
glm::vec3 LinkRadiosity::brought(std::size_t i, std::size_t k) const
{
    glm::vec3 sky(0.0f);
    std::uint32_t rays = 0;
    for (std::uint32_t p = parts_->first(i); p < parts_->end(i); ++p) {
        rays += sources_[k].rays[p];
        sky += links_[k]->sky[p];
    }
    if (rays > 0)
        sky /= float(rays);
    switch (parts_wanted_) {
    case Parts::all:
        return indirect(i, k);
    case Parts::direct:
        return sky;
    case Parts::indirect:
        return indirect(i, k) - sky;
    }
    return {};
}

/// Irradiance by all rays at a lumel in one solution [lx].
glm::vec3 LinkRadiosity::indirect(std::size_t i, std::size_t k) const
{
    glm::vec3 sum(0.0f);
    std::uint32_t rays = 0;
    for (std::uint32_t p = parts_->first(i); p < parts_->end(i); ++p) {
        rays += sources_[k].rays[p];
        sum += float(sources_[k].rays[p]) * received_[k][p];
    }
    return rays > 0 ? sum / float(rays) : glm::vec3(0.0f);
}

/// The filter for the present links; null: none.
const ChartFilter* LinkRadiosity::filter()
{
    if (!options_.filter)
        return nullptr;
    if (!filter_)
        filter_.emplace(work_, *parts_,
                        find_distances(work_, *parts_, *numbers_,
                                       std::array{&*links_[0], &*links_[1], &*links_[2]}));
    return &*filter_;
}

/// Averages the solutions.
void LinkRadiosity::combine()
{
    Solutions found;
    for (std::size_t k = 0; k < kSolutions; ++k) {
        found[k].resize(work_.lumels().size());
        for (std::size_t i = 0; i < found[k].size(); ++i)
            found[k][i] = brought(i, k);
    }
    mean_ = filter() ? filter()->indirect(found) : plain_mean(found);
}

/// Adds the error of direct light to that of rays.
void LinkRadiosity::estimate()
{
    struct Sums {
        SquaredError rays;
        SquaredError direct;
        double light = 0.0, count = 0.0;

        /// √(Σ d² / 3n) / (Σ H / 3n), squared
        double relative(double squares) const
        {
            return light > 0.0 ? 3.0 * count * squares / (light * light) : 0.0;
        }
        Errors errors() const { return {relative(rays.sum()), relative(direct.sum())}; }
    };
    direct_mean_ = filter() && parts_wanted_ != Parts::indirect
                       ? filter()->direct(direct_->half(0), direct_->half(1))
                       : plain_mean(direct_->half(0), direct_->half(1));
    const auto add = [&](Sums& sums, std::size_t i, double light) {
        if (parts_wanted_ != Parts::indirect)
            sums.direct.add(direct_mean_, i);
        if (!mean_.light.empty())
            sums.rays.add(mean_, i);
        sums.light += light;
        sums.count += 1.0;
    };
    const auto visit = [&](const auto& what) {
        for (std::size_t i = 0; i < work_.lumels().size(); ++i)
            if (!work_.is_buried(i)) {
                const glm::vec3 all = arrived(i);
                what(i, double(all.r + all.g + all.b));
            }
    };
    Sums all, dark;
    visit([&](std::size_t i, double light) { add(all, i, light); });
    mean_light_ = all.light / std::max(all.count, 1.0);
    visit([&](std::size_t i, double light) {
        if (light < kDark * mean_light_)
            add(dark, i, light);
    });
    all_ = all.errors();
    dark_ = dark.errors();
    state_.error = std::sqrt(all_.rays + all_.direct);
    eye_ = estimate_for_eye();
    state_.dark_error = std::sqrt(dark_.rays + dark_.direct);
    state_.eye_error = std::sqrt(eye_.rays + eye_.direct);
}

VisibleNoise LinkRadiosity::visible_noise() const
{
    if (mean_.light.empty())
        return {};
    std::vector<float> light(work_.lumels().size());
    for (std::size_t i = 0; i < light.size(); ++i)
        light[i] = float(luminance(arrived(i)));
    std::vector<const Mean*> means = {&mean_};
    if (parts_wanted_ != Parts::indirect)
        means.push_back(&direct_mean_);
    return lumel::visible_noise(work_.scene, light, means);
}

/// Mean of squared errors relative to the light that an eye adapts to.
LinkRadiosity::Errors LinkRadiosity::estimate_for_eye()
{
    std::vector<double> light(work_.lumels().size());
    for (std::size_t i = 0; i < light.size(); ++i) {
        const glm::vec3 all = arrived(i);
        light[i] = double(all.r + all.g + all.b);
    }
    adapted_ = adapted_light(work_.scene.lumels, light);
    SquaredError rays, direct;
    double count = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        if (work_.is_buried(i))
            continue;
        count += 1.0;
        if (!(adapted_[i] > 0.0))
            continue;
        // √(Σ d² / 3) / (Σ adapted / 3), squared
        const double weight = 3.0 / (adapted_[i] * adapted_[i]);
        if (parts_wanted_ != Parts::indirect)
            direct.add(direct_mean_, i, weight);
        if (!mean_.light.empty())
            rays.add(mean_, i, weight);
    }
    return {rays.sum() / std::max(count, 1.0), direct.sum() / std::max(count, 1.0)};
}

/// Irradiance at a lumel, of the requested parts of light [lx].
glm::vec3 LinkRadiosity::arrived(std::size_t i) const
{
    const glm::vec3 direct = parts_wanted_ == Parts::indirect ? glm::vec3(0.0f)
                             : direct_mean_.light.empty()     ? direct_->mean(i)
                                                              : direct_mean_.light[i];
    return mean_.light.empty() ? direct : direct + mean_.light[i];
}

/// The square of one lumel is a rough estimate, so that of its neighbours counts too.
std::vector<float> LinkRadiosity::error_estimate() const
{
    std::vector<float> error(work_.lumels().size(), 1.0f);
    if (mean_.light.empty())
        return error;
    std::vector<double> square(error.size());
    for (std::size_t i = 0; i < square.size(); ++i)
        square[i] = double(mean_.noise[i]) +
                    (parts_wanted_ == Parts::indirect ? 0.0 : double(direct_mean_.noise[i]));
    const std::vector<double> deviation = deviation_nearby(square, work_.order, 1.0);
    for (std::size_t i = 0; i < error.size(); ++i) {
        const glm::vec3 all = arrived(i);
        const double light = double(all.r + all.g + all.b);
        // √(Σ d² / 3) / (Σ H / 3)
        error[i] = work_.is_buried(i) || !(light > 0.0)
                       ? 0.0f
                       : float(std::min(std::sqrt(3.0) * deviation[i] / light, 1.0));
    }
    return error;
}

std::vector<glm::vec3> LinkRadiosity::irradiance()
{
    std::vector<glm::vec3> result(work_.lumels().size(), glm::vec3(0.0f));
    if (direct_)
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] = arrived(i);
    return result;
}

}  // namespace lumel
