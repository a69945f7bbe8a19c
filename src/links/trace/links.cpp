// Radiosity over links. The irradiance of a lumel is direct light D, from shadow rays to light
// sources, plus light along cosine-distributed rays. Each of these is traced once. The sub-lumel
// and the cell that it hits are stored, a link of four bytes, and X = C + K ρ X, with C the light
// of sources at the ends of links, is solved over the links, sweep by sweep, for all bounces at
// once (links/sweeps/sweeps.cpp). The cost grows linearly with the number of lumels.
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
#include "base/core/log.h"
#include "base/core/luminance.h"
#include "base/core/state_bytes.h"
#include "base/core/usage.h"
#include "links/direct/deviation.h"
#include "links/filter/adapted_light.h"
#include "links/filter/visible_noise.h"
#include "links/kept/link_rows.h"
#include "links/rays/shared_directions.h"
#include "links/trace/link_casters.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Blocks of links per step and rank, at the first round's number of rays.
constexpr std::size_t kBlocksPerStep = 128;
/// Blocks per step when rasterising, whose cost hardly grows with them: a million rays (200 MB).
constexpr std::size_t kBlocksPerDrawing = 512;
/// Fraction of the first round that direct light takes, for the progress bar only.
constexpr double kDirectOfRound = 0.5;
/// Minimum mean albedo of rooms whose level is balanced.
constexpr double kBrightRoom = 0.95;
/// Maximum mean albedo of rooms where rays are guided: the weights of a lumel's links sum to 1 only
/// in the mean, which light that is reflected for long would amplify.
constexpr double kBrightestGuided = 0.9;

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

LinkRadiosity::LinkRadiosity(const gpu::Device* device, const SolveScene& scene,
                             const LinksOptions& options, const SolveLimits& limits, Parts parts,
                             Ranks* ranks)
    : LinkRadiosity(scene, casters_for(device, scene.rays, options.rays), options, limits, parts,
                    ranks)
{
}

LinkRadiosity::LinkRadiosity(const SolveScene& scene, const LinksOptions& options,
                             const SolveLimits& limits, Parts parts)
    : LinkRadiosity(scene, {.rays = cast_on_host(scene.rays)}, options, limits, parts, nullptr)
{
}

LinkRadiosity::LinkRadiosity(const SolveScene& scene, LinkWork::Casters casters,
                             const LinksOptions& options, const SolveLimits& limits, Parts parts,
                             Ranks* ranks)
    : options_(options),
      target_error_(limits.target_error),
      target_dark_error_(limits.target_dark_error),
      target_eye_error_(limits.target_quality.eye_error),
      target_visible_noise_(limits.target_quality.visible_noise),
      most_shots_(limits.max_shots),
      most_bytes_(limits.max_bytes),
      most_device_bytes_(limits.max_device_bytes),
      parts_wanted_(parts),
      work_(scene, std::move(casters), options.rule, order_in_space,
            options.outside_light ? kNoSources : LightSelection{}, ranks),
      lamps_(options.outside_light ? std::optional(LampTable{})
             : options.per_lamp ? std::optional(find_lamps(scene.scene, scene.lumels, work_.sources,
                                                           options.groups))
                                : std::nullopt),
      // Ranks share the sweeps of the CPU.
      sweeping_(count_of(ranks) > 1 ? nullptr : work_.casters.device)
{
}

LinkRadiosity::~LinkRadiosity() = default;

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
        if (state_.shots == 0 || has_known_round()) {
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
            direct_mean_.apart, direct_mean_.bend, round_, mean_rays_, means_, rays_, guide_,
            traced_, mean_.light, mean_.noise, mean_.wrong, mean_.apart, mean_.bend, mean_light_,
            adapted_, errors_, refined_, passes_, state_, times_);
    for (std::size_t k = 0; k < kSolutions; ++k) {
        links_state(archive, *links_[k]);
        archive(sources_[k].rays, received_[k], swept_sky_[k]);
    }
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
    find_visible_noise();
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
    const auto is_sound = [&](const StoredLinks::Pass& pass) { return pass.fits(lumels, round_); };
    bool fits = stage_ > Stage::begin && stage_ <= Stage::solve && direct_->fits() &&
                is(direct_mean_.light.size(), lumels) &&
                direct_mean_.noise.size() == direct_mean_.light.size() &&
                direct_mean_.wrong.size() == direct_mean_.light.size() &&
                direct_mean_.apart.size() == direct_mean_.light.size() &&
                direct_mean_.bend.size() == direct_mean_.light.size() &&
                is(mean_.light.size(), lumels) && is(mean_.noise.size(), lumels) &&
                is(mean_.wrong.size(), lumels) && is(mean_.apart.size(), lumels) &&
                is(mean_.bend.size(), lumels) && is(adapted_.size(), lumels) &&
                traced_ <= tracer_->blocks() && means_.size() == round_ && guide_.fits(lumels) &&
                (state_.shots > 0) == !mean_.light.empty() &&
                (round_ > 0 || (state_.shots == 0 && (guide_.empty() || is_tracing))) &&
                std::ranges::all_of(passes_, is_sound) && (!is_tracing || mean_rays_ > 0.0) &&
                (stage_ != Stage::solve || traced_ == tracer_->blocks());
    for (std::size_t k = 0; k < kSolutions; ++k)
        fits = fits && links_[k]->rounds.size() == round_ + (is_tracing ? 1 : 0) &&
               rays_[k].size() == (is_tracing || round_ > 0 ? lumels : 0) &&
               links_[k]->fits(work_, *parts_, *numbers_, traced, lamp_count(), has_bins()) &&
               swept_sky_[k].size() == (lamps_ && !mean_.light.empty() ? parts : 0) &&
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
                   PathSamples::hash(options_.seed, kPartStream), work_.ranks);
    numbers_.emplace(work_.scene.scene.instances.size(), parts_->count());
    solver_.emplace(work_, *parts_, *numbers_);
    find_light();
}

/// Prepares direct light and links of the present sources.
void LinkRadiosity::find_light()
{
    direct_.emplace(work_, PathSamples::hash(options_.seed, kDirectStream), &*parts_, lamps());
    tracer_.emplace(work_, *parts_, *numbers_, *direct_, options_.seed, lamps(),
                    options_.outside_light);
    for (std::optional<LinkTable>& links : links_)
        links.emplace(parts_->count());
    can_guide_ = options_.guide && options_.even_rays == 0 && !shares_directions() &&
                 mean_albedo() <= kBrightestGuided;
    release();
    sealed_.emplace(work_, *parts_, *numbers_);
}

/// Traces a step of the round's rays.
void LinkRadiosity::trace()
{
    const std::size_t blocks = work_.casters.bundles ? kBlocksPerDrawing : kBlocksPerStep;
    const std::size_t count =
        count_of(work_.ranks) *
        std::max(std::size_t(double(blocks * kFirstRays) / mean_rays_), std::size_t(1));
    const std::size_t last = std::min(traced_ + count, tracer_->blocks());
    const bool shares = shares_directions();
    for (std::uint32_t k = 0; k < kSolutions; ++k) {
        std::optional<SharedDirections> shared;
        if (shares)
            shared.emplace(mean_rays_,
                           PathSamples::hash(PathSamples::hash(options_.seed, kSharedStream),
                                             LinkTracer::stream(round_, k)));
        LinkTracer::Sending sending{rays_[k], round_, k, shared ? &*shared : nullptr,
                                    has_bins() ? &guide_ : nullptr};
        if (has_known_round())
            sending.known.emplace(
                LinkTracer::Known{changes_, stored_->rounds[round_], first_rays_[k], k});
        tracer_->trace(traced_, last, sending, *links_[k]);
    }
    share_sky(traced_, last);
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
    check_agreement();
}

/// Sweeps on the device. Throws gpu::OutOfMemory.
double LinkRadiosity::sweep_on(const gpu::Device& device, std::size_t k, double least_factor)
{
    std::uint64_t left = most_device_bytes_;
    const auto take = [&](std::uint64_t bytes) {
        if (left > 0 && bytes >= left)
            throw gpu::OutOfMemory(device.info().name,
                                   "has too little memory for sweeps beside all else");
        left -= left > 0 ? bytes : 0;
    };
    take(DeviceSweeps::bytes(parts_->count()));
    for (const DeviceLinks& links : device_links_)
        take(links.bytes());
    if (!device_sweeps_)
        device_sweeps_.emplace(device, solver_->albedo());
    device_links_[k].update(device, {work_, *parts_, *numbers_}, *links_[k], {.bytes = left});
    return solver_
        ->solve_on(*device_sweeps_, device_links_[k], *links_[k], sources_[k], sweep_residual(),
                   received_[k], least_factor)
        .factor;
}

void LinkRadiosity::release()
{
    device_sweeps_.reset();
    device_links_ = {};
}

/// Solves over the links of a solution, on the device that casts rays or on the CPU.
/// Returns the factor between changes.
double LinkRadiosity::sweep(std::size_t k, double least_factor)
{
    if (sweeping_)
        try {
            return sweep_on(*sweeping_, k, least_factor);
        } catch (const gpu::OutOfMemory& error) {
            log_info(std::string("sweeping on the CPU: ") + error.what());
            sweeping_ = nullptr;
            release();
        }
    return solver_->solve(*links_[k], sources_[k], sweep_residual(), received_[k], least_factor)
        .factor;
}

/// Weighs guided rays among those of all rounds.
void LinkRadiosity::weigh_rays()
{
    if (!has_bins())
        for (std::optional<LinkTable>& links : links_)
            for (LinkBlock& block : links->rounds.front())
                block.bins = std::vector<std::uint8_t>();  // frees them
    if (guide_.empty())
        return;
    for (std::uint32_t k = 0; k < kSolutions; ++k)
        tracer_->weigh(guide_, k, *links_[k]);
    share_sky(0, tracer_->blocks());
    device_links_ = {};
}

/// Solves for all bounces over the links of each solution.
void LinkRadiosity::solve()
{
    const ReflectedLight reflected(work_, *parts_, *numbers_, *direct_);
    double factor = 0.0;
    weigh_rays();
    for (std::size_t k = 0; k < kSolutions; ++k) {
        sources_[k] = find_source_term(work_, *parts_, *numbers_, reflected, *links_[k]);
        // From the light of the first: only a residual's share of that is left.
        if (k > 0 && received_[k].empty())
            received_[k] = received_[0];
        factor = sweep(k, factor);
        sources_[k].light = std::vector<glm::vec4>();  // frees it
        if (lamps_)
            swept_sky_[k] = links_[k]->sky;
        balance(k);
    }
}

void LinkRadiosity::end_round()
{
    state_.shots += std::uint64_t(std::llround(double(kSolutions) * mean_rays_));
    means_.push_back(mean_rays_);
    ++round_;
    if (has_known_round()) {
        begin_round();
        return;
    }
    solve();
    combine();
    estimate();
    go_on();
}

/// Of all surfaces, by area.
double LinkRadiosity::mean_albedo() const
{
    double area = 0.0, reflected = 0.0;
    for (const Lumel& lumel : work_.lumels()) {
        if (lumel.flags & kLumelBuried)
            continue;
        const double albedo = double(lumel.albedo.r + lumel.albedo.g + lumel.albedo.b) / 3.0;
        area += double(lumel.area);
        reflected += double(lumel.area) * albedo;
    }
    return area > 0.0 ? reflected / area : 0.0;
}

/// In a bright closed room the overall level of the light is noisy, but the absorbed light is
/// known: it equals the direct light, Σ A (1 - ρ) (D + X) = Σ A D.
void LinkRadiosity::balance(std::size_t k)
{
    if (!sources_[k].is_closed || mean_albedo() < kBrightRoom)
        return;
    glm::dvec3 absorbed(0.0), reflected(0.0);
    for (std::size_t i = 0; i < work_.lumels().size(); ++i) {
        const Lumel& lumel = work_.lumels()[i];
        if (lumel.flags & kLumelBuried)
            continue;
        const double a = double(lumel.area);
        absorbed += a * glm::dvec3((1.0f - lumel.albedo) * indirect(i, k));
        reflected += a * glm::dvec3(lumel.albedo * direct_->mean(i));
    }
    glm::vec3 factor(1.0f);
    for (int c = 0; c < 3; ++c)
        if (absorbed[c] > 0.0)
            factor[c] = float(reflected[c] / absorbed[c]);
    for (glm::vec3& light : received_[k])
        light *= factor;
}

/// Irradiance by rays at a lumel in one solution, of the requested parts of light [lx].
glm::vec3 LinkRadiosity::brought(std::size_t i, std::size_t k) const
{
    glm::vec3 sky(0.0f);
    float rays = 0.0f;
    for (std::uint32_t p = parts_->first(i); p < parts_->end(i); ++p) {
        rays += sources_[k].rays[p];
        sky += links_[k]->sky[p];
    }
    if (rays > 0.0f)
        sky /= rays;
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
    float rays = 0.0f;
    for (std::uint32_t p = parts_->first(i); p < parts_->end(i); ++p) {
        rays += sources_[k].rays[p];
        sum += sources_[k].rays[p] * received_[k][p];
    }
    return rays > 0.0f ? sum / rays : glm::vec3(0.0f);
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

/// brought() of all lumels.
Solutions LinkRadiosity::brought_light() const
{
    Solutions found;
    for (std::size_t k = 0; k < kSolutions; ++k) {
        found[k].resize(work_.lumels().size());
        for (std::size_t i = 0; i < found[k].size(); ++i)
            found[k][i] = brought(i, k);
    }
    return found;
}

/// Averages the solutions.
void LinkRadiosity::combine()
{
    const Solutions found = brought_light();
    mean_ = filter() ? filter()->indirect(found) : plain_mean(found);
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
