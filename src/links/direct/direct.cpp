// Random numbers of the two halves are independent.
//
// A few rays show which lumels see parts of sources. These start over with many, so that the result
// does not depend on the first ones (no bias). Later passes add rays where neighbours are
// uncertain.

#include "links/direct/direct.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "atlas/cells/lumel_samples.h"
#include "base/core/luminance.h"
#include "base/core/parallel.h"
#include "lights/source_estimate.h"
#include "links/direct/found_light.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// To small sources, whose shadows are sharp, this many times kFewRays or kManyRays go.
constexpr std::uint32_t kTimesToSmall = 2;
/// Sources whose sampling weight is below this fraction of a lumel's total share their rays.
constexpr float kOwnRays = 1.0f / 16.0f;
/// Maximum number of times that the rays of a source are halved, relative to the strongest source.
constexpr std::uint32_t kMaxHalved = 3;

/// Maximum number of sources sampled by a point that is not a lumel.
constexpr std::uint32_t kMaxSought = 2;

/// Random stream of the first pass of many rays; later ones follow by the rays before them.
constexpr std::uint32_t kManyStream = 0x10000;

/// Dimension pairs of a ray's random numbers.
constexpr std::uint32_t kLumelPair = 0, kLampChoicePair = 1, kLampPair = 2;

}  // namespace

/// Rays from a lumel to one source, or to several that share them: those of half 0, then half 1.
struct DirectEstimator::Group {
    std::uint32_t source;
    bool alone;
    std::uint32_t first, rays;  ///< shadow rays, per half
};

/// Lumels whose shadow rays are traced together.
struct DirectEstimator::RayBatch {
    std::size_t first = 0;                     ///< first lumel, in the list of the pass
    std::vector<std::uint32_t> lumels;         ///< consecutive lumels of that list
    std::vector<std::uint32_t> groups_before;  ///< [lumels + 1]
    std::vector<Group> groups;
    ShadowRays looks;
    std::vector<std::uint32_t> cells;  ///< [looks] cell of the lumel that the ray starts in

    explicit RayBatch(std::size_t from) { begin(from); }
    void begin(std::size_t from)
    {
        first = from;
        lumels.clear();
        groups_before.assign(1, 0);
        groups.clear();
        looks.clear();
        cells.clear();
    }
};

/// One source of several, and the factor by which its light represents the others.
struct DirectEstimator::Choice {
    std::uint32_t source;
    float factor;
};

DirectEstimator::DirectEstimator(const LinkWork& work, std::uint32_t seed, const SubLumels* parts,
                                 const LampTable* lamps)
    : work_(work),
      seed_(seed),
      parts_(parts),
      of_lamps_(lamps),
      lamps_(lamps ? lamps->all.size() : 0),
      half_{std::vector<glm::vec3>(work.order.size()), std::vector<glm::vec3>(work.order.size())},
      lamp_half_{std::vector<glm::vec3>(work.order.size() * lamps_),
                 std::vector<glm::vec3>(work.order.size() * lamps_)},
      taken_(work.order.size()),
      more_(work.order.size()),
      seen_(work.order.size()),
      uncertain_(work.order.size()),
      by_cell_{1, std::vector<std::uint32_t>(work.order.size(), kSame), {}},
      lamps_by_cell_{lamps_, std::vector<std::uint32_t>(lamps ? work.order.size() : 0, kSame), {}},
      blocks_((work.order.size() + kBlock - 1) / kBlock)
{
}

/// Strong sources have their own rays, in proportion to their sampling weights. `rest`: cumulative
/// weights over all sources, 0 for the strong ones.
std::vector<DirectEstimator::RaysTo> DirectEstimator::share_out_rays(const Receiver& receiver,
                                                                     std::vector<float>& rest) const
{
    rest.resize(work_.sources.count());
    float total = 0.0f, most = 0.0f;
    for (std::uint32_t s = 0; s < work_.sources.count(); ++s) {
        total += rest[s] = work_.sources.sampling_weight(s, receiver);
        most = std::max(most, rest[s]);
    }
    if (!(total > 0.0f))
        return {};
    const auto halved = [&](float guess) {
        const float times = std::round(std::log2(most / guess));
        return std::uint32_t(std::clamp(times, 0.0f, float(kMaxHalved)));
    };
    std::vector<RaysTo> result;
    float sum = 0.0f;
    for (std::uint32_t s = 0; s < work_.sources.count(); ++s) {
        if (rest[s] >= kOwnRays * total) {
            result.push_back({.source = s, .halved = halved(rest[s])});
            rest[s] = 0.0f;
        }
        rest[s] = sum += rest[s];
    }
    if (sum > 0.0f)
        result.push_back({.halved = halved(sum), .rest = &rest});
    return result;
}

/// Selects a source by cumulative weights.
DirectEstimator::Choice DirectEstimator::choose(const std::vector<float>& running, float at)
{
    const float mark = at * running.back();
    const auto found = std::upper_bound(running.begin(), running.end() - 1, mark);
    const auto source = std::uint32_t(found - running.begin());
    const float own = *found - (source > 0 ? running[source - 1] : 0.0f);
    return {source, own > 0.0f ? running.back() / own : 0.0f};
}

/// Queues a shadow ray to a point on a source. factor: scales its light if it represents other
/// sources.
void DirectEstimator::look(const RayOrigin& start, std::size_t source, float factor,
                           const glm::vec2& at, std::uint32_t seed, ShadowRays& looks) const
{
    SourceSample sample = work_.sources.sample(source, start, at);
    if (factor != 1.0f) {
        sample.irradiance *= factor;
        sample.open.reset();
    }
    looks.add(sample, ray_towards(sample, start, seed));
}

std::uint32_t DirectEstimator::looks_around() const
{
    return std::min(std::uint32_t(work_.sources.count()), kMaxSought);
}

void DirectEstimator::sample_lights(const RayOrigin& start, float size, std::uint32_t seed,
                                    ShadowRays& looks) const
{
    const auto place_on = [&](std::uint32_t k) {
        const std::uint32_t own = PathSamples::hash(seed, k);
        return glm::vec2(PathSamples::to_unit(own),
                         PathSamples::to_unit(PathSamples::hash(own, 1)));
    };
    const auto add = [&](std::size_t source, float factor, std::uint32_t k) {
        look(start, source, factor, place_on(k), PathSamples::hash(seed, ~k), looks);
    };
    const auto count = std::uint32_t(work_.sources.count());
    if (count <= kMaxSought) {
        for (std::uint32_t s = 0; s < count; ++s)
            add(s, 1.0f, s);
        return;
    }
    // A few, selected by sampling weight.
    const Box around = Box{start.position, start.position}.grown(0.5f * size);
    const Receiver receiver{around, start.position, start.geometric};
    std::vector<float> running(count);
    float sum = 0.0f;
    for (std::uint32_t s = 0; s < count; ++s)
        running[s] = sum += work_.sources.sampling_weight(s, receiver);
    for (std::uint32_t k = 0; k < kMaxSought; ++k) {
        const Choice choice =
            choose(running, (place_on(count + k).x + float(k)) / float(kMaxSought));
        add(choice.source, choice.factor / float(kMaxSought), k);
    }
}

glm::vec3 DirectEstimator::light_of(const ShadowRays& looks, std::uint32_t first) const
{
    glm::vec3 light(0.0f);
    for (std::uint32_t look = first; look < first + looks_around(); ++look)
        light += looks.transmittance(look) * looks.sample(look).irradiance;
    return light;
}

/// Adds a lumel's rays to one source, or to the remaining sources together.
void DirectEstimator::add_rays(std::uint32_t i, const RaysTo& to, std::uint32_t more,
                               const SeenCells* seen, RayBatch& wave) const
{
    const bool many = more > 0, alone = !to.rest,
               small = alone && work_.sources.is_small(to.source);
    const std::uint32_t times = small ? kTimesToSmall : 1;
    const std::uint32_t rays = times * (many ? more >> to.halved : kFewRays);
    wave.groups.push_back({to.source, alone, wave.looks.size(), rays});
    for (std::uint32_t h = 0; h < 2; ++h) {
        const std::uint32_t pass = many ? kManyStream + taken_[i] : 0;
        const std::uint32_t of_source = 2 * to.source + (alone ? 0 : 1);
        const LumelSamples own(
            work_.lumels()[i], std::uint32_t(work_.scene.lumels.width),
            PathSamples::hash(PathSamples::hash(PathSamples::hash(seed_, h), pass), of_source),
            rays);
        for (std::uint32_t k = 0; k < rays; ++k) {
            const PathSamples samples = own[k];
            const RayOrigin start = work_.starts.start(i, samples.stratified(kLumelPair));
            const Choice choice = alone ? Choice{to.source, 1.0f}
                                        : choose(*to.rest, samples.stratified(kLampChoicePair).x);
            const std::uint32_t cell =
                seen ? seen->nearest({start.position, start.normal}) : start.cell;
            look(start, choice.source, choice.factor, samples.stratified(kLampPair),
                 samples.bits(kLampPair), wave.looks);
            wave.cells.push_back(cell);
        }
    }
}

/// Adds the rays of lumel i in this pass.
void DirectEstimator::add(std::uint32_t i, RayBatch& wave) const
{
    std::vector<float> rest;
    std::optional<SeenCells> seen;
    if (parts_ && parts_->has_hidden(i))
        seen.emplace(parts_->seen_cells(i));
    if (!work_.is_buried(i))
        for (const RaysTo& to : share_out_rays(receiver_of(work_.world, i), rest))
            add_rays(i, to, more_[i], seen ? &*seen : nullptr, wave);
    wave.lumels.push_back(i);
    wave.groups_before.push_back(std::uint32_t(wave.groups.size()));
}

/// Adds the results of a group's rays.
void DirectEstimator::take(const Group& group, std::uint32_t i, const RayBatch& wave,
                           Found& found) const
{
    const auto part = [&](std::uint32_t cell) { return part_of(i, cell); };
    OfLumel light;
    std::array<SourceEstimate, kCells> of_cells;
    std::array<SourceEstimate, kMaxWithCells> of_parts;
    SourceEstimate of_both;
    for (std::uint32_t h = 0; h < 2; ++h) {
        SourceEstimate sums;
        const std::uint32_t first = group.first + h * group.rays;
        for (std::uint32_t look = first; look < first + group.rays; ++look) {
            const SourceSample& sample = wave.looks.sample(look);
            const glm::vec3 transmittance = wave.looks.transmittance(look);
            sums.add(sample, transmittance);
            of_both.add(sample, transmittance);
            if (const std::uint32_t cell = wave.cells[look]; cell != kNoCell) {
                of_cells[cell].add(sample, transmittance);
                of_parts[part(cell)].add(sample, transmittance);
            }
        }
        light.half[h] = sums.light();
    }
    found.rays += of_both.free + of_both.hidden;
    found.uncertain = found.uncertain || (of_both.free > 0 && of_both.hidden > 0);
    found.exact = found.exact && of_both.exact;
    if (of_both.free > 0)
        found.seen |= 1u << (group.alone ? group.source % 32 : 31);
    // The ratios of a few rays are biased: those of cells have the mean of their sub-lumel.
    std::array<glm::vec3, kMaxWithCells> sum{};
    std::array<float, kMaxWithCells> rays{};
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c) {
        sum[part(c)] += float(of_cells[c].rays) * of_cells[c].light();
        rays[part(c)] += float(of_cells[c].rays);
    }
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c) {
        const std::uint32_t p = part(c);
        const glm::vec3 mean = of_parts[p].light();
        light.cells[c] = of_cells[c].rays > 0 ? of_cells[c].light() : mean;
        for (int k = 0; of_cells[c].rays > 0 && k < 3; ++k)
            light.cells[c][k] *= sum[p][k] > 0.0f ? rays[p] * mean[k] / sum[p][k] : 1.0f;
    }
    found.light.add(light);
    if (of_lamps_ && group.alone)
        found.of_lamps[of_lamps_->of_source[group.source]].add(light);
    else if (of_lamps_)
        share_out(group, i, wave, light, found);
}

/// Shares out the light of several sources to their lamps, in proportion to what rays to them
/// brought: to the half; and to the cell, else to its sub-lumel, where cells will be kept.
void DirectEstimator::share_out(const Group& group, std::uint32_t i, const RayBatch& wave,
                                const OfLumel& light, Found& found) const
{
    struct OfCellsAndParts {
        OfCells cells{};
        std::array<glm::vec3, kMaxWithCells> parts{};
    };
    const bool by_cell = more_[i] > 0 || is_cut(i);
    // The last is of all lamps.
    std::vector<std::array<glm::vec3, 2>> halves(lamps_ + 1);
    std::vector<OfCellsAndParts> places(by_cell ? lamps_ + 1 : 0);
    for (std::uint32_t n = 0; n < 2 * group.rays; ++n) {
        const std::uint32_t look = group.first + n, cell = wave.cells[look];
        const SourceSample& sample = wave.looks.sample(look);
        const glm::vec3 sent = wave.looks.transmittance(look) * sample.irradiance;
        for (const std::size_t lamp : {std::size_t(of_lamps_->of_source[sample.source]), lamps_}) {
            halves[lamp][n / group.rays] += sent;
            if (by_cell && cell != kNoCell) {
                places[lamp].cells[cell] += sent;
                places[lamp].parts[part_of(i, cell)] += sent;
            }
        }
    }
    const auto share = [](const glm::vec3& of, const glm::vec3& sum) {
        glm::vec3 result(0.0f);
        for (int c = 0; c < 3; ++c)
            result[c] = sum[c] > 0.0f ? of[c] / sum[c] : 0.0f;
        return result;
    };
    for (std::size_t lamp = 0; lamp < lamps_; ++lamp) {
        OfLumel& into = found.of_lamps[lamp];
        for (std::size_t h = 0; h < 2; ++h)
            into.half[h] += share(halves[lamp][h], halves[lamps_][h]) * light.half[h];
        for (std::uint32_t c = 0; by_cell && c < std::uint32_t(kCells); ++c) {
            const OfCellsAndParts &own = places[lamp], &all = places[lamps_];
            const std::uint32_t p = part_of(i, c);
            into.cells[c] += (all.cells[c] != glm::vec3(0.0f) ? share(own.cells[c], all.cells[c])
                                                              : share(own.parts[p], all.parts[p])) *
                             light.cells[c];
        }
    }
}

void DirectEstimator::take(const RayBatch& wave)
{
    for (std::size_t k = 0; k < wave.lumels.size(); ++k) {
        const std::uint32_t i = wave.lumels[k];
        Found found;
        found.of_lamps.resize(lamps_);
        for (std::uint32_t g = wave.groups_before[k]; g < wave.groups_before[k + 1]; ++g)
            take(wave.groups[g], i, wave, found);
        // Cells are used only if all sources have exact unoccluded light, or the lumel is cut.
        if (more_[i] == 0 && !found.exact && !is_cut(i)) {
            found.light.make_even();
            for (OfLumel& lamp : found.of_lamps)
                lamp.make_even();
        }
        keep(i, found, blocks_[(wave.first + k) / kBlock]);
    }
}

/// Processes the lumels of blocks [first, last) of a list.
void DirectEstimator::find(const std::vector<std::uint32_t>& lumels, std::size_t first,
                           std::size_t last)
{
    const std::size_t begin = first * kBlock, end = std::min(last * kBlock, lumels.size());
    RayBatch wave(begin);
    for (std::size_t k = begin; k < end; ++k) {
        add(lumels[k], wave);
        if (wave.looks.size() < work_.caster().batch() && k + 1 < end)
            continue;
        wave.looks.cast(work_.caster());
        take(wave);
        wave.begin(k + 1);
    }
}

bool DirectEstimator::fits() const
{
    const std::size_t count = work_.order.size();
    const auto is_lumel = [&](std::uint32_t i) { return i < count; };
    const auto are_lumels = [&](const Block& block) {
        return block.light.fits(count, 1) && block.of_lamps.fits(count, lamps_);
    };
    return half_[0].size() == count && half_[1].size() == count && taken_.size() == count &&
           more_.size() == count && seen_.size() == count && uncertain_.size() == count &&
           by_cell_.fits(count) && lamps_by_cell_.fits(lamps_ > 0 ? count : 0) &&
           done_ <= blocks_.size() && lamp_half_[0].size() == lamps_ * count &&
           lamp_half_[1].size() == lamps_ * count && std::ranges::all_of(many_, is_lumel) &&
           std::ranges::all_of(blocks_, are_lumels);
}

std::uint64_t DirectEstimator::bytes(std::size_t lumels, std::size_t varying, std::size_t lamps,
                                     std::size_t varying_by_lamp)
{
    constexpr std::size_t kOfLumel =
        2 * sizeof(glm::vec3) + 5 * sizeof(std::uint32_t) + sizeof(char);
    return lumels * (kOfLumel + lamps * 2 * sizeof(glm::vec3)) +
           (varying + lamps * varying_by_lamp) * sizeof(OfCells);
}

}  // namespace lumel
