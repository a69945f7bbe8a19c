// Rays of lumels, from their start to their first hit, and what is kept of them. Those that go on
// are in links/rays/paths.cpp.

#include "links/rays/tracer.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include <glm/gtc/packing.hpp>

#include "base/core/frame.h"
#include "base/core/parallel.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"
#include "base/ranks/rank_blocks.h"
#include "links/rays/ray_batch.h"

namespace lumel {
namespace {

/// A first hit closer than kNearSides gets shadow rays if it is closer than this, or if direct
/// light varies within the lumel; otherwise the lumel's has less noise.
constexpr float kNearForCells = 1.0f;

}  // namespace

LinkTracer::LinkTracer(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers,
                       const DirectEstimator& direct, std::uint32_t seed, const LampTable* lamps,
                       bool outside_light)
    : work_(work),
      parts_(parts),
      numbers_(numbers),
      stored_(work.scene.scene.instances.size(), work.lumels().size()),
      direct_(direct),
      hits_(work.scene.scene, work.scene.atlas, work.scene.lumels),
      seed_(seed),
      lamps_(lamps),
      outside_light_(outside_light),
      margin_(work.scene.rays.ray_offset())
{
}

std::span<const LinkEnd> LinkTracer::Known::of(std::size_t i, std::size_t rays) const
{
    const bool fits = !changes.all && !changes.starts[i] && round.rays[solution][i] == rays;
    return fits ? std::span(round.ends[solution]).subspan(first_rays[i], rays)
                : std::span<const LinkEnd>();
}

/// The end that a ray still has unless it meets something that moved; empty if it can have changed.
std::optional<LinkEnd> LinkTracer::still(LinkEnd stored, const Known& known) const
{
    const std::uint32_t number = stored.number();
    if (number == LinkNumbers::kNear || known.changes.ends[number])
        return std::nullopt;
    return stored_.is_part(number)
               ? LinkEnd::of(numbers_.of_part(parts_.part(stored_.part(number), stored.cell())),
                             stored.cell())
               : stored;
}

bool LinkTracer::may_meet_moved(const RaySpan& ray, const LinkChanges& changes) const
{
    return std::any_of(
        changes.moved.begin(), changes.moved.end(), [&](const LinkChanges::Moved& moved) {
            return moved.box.may_meet(ray.origin, ray.direction, ray.far, margin_) &&
                   (moved.blends || moved.tree.transmittance(ray) != glm::vec3(1.0f));
        });
}

/// Random numbers of the rays that lumel i sends in a round.
LumelSamples LinkTracer::samples_of(std::uint32_t i, std::uint32_t round, std::uint32_t solution,
                                    std::size_t rays) const
{
    return {work_.lumels()[i], std::uint32_t(work_.scene.lumels.width),
            PathSamples::hash(seed_, stream(round, solution)), std::uint32_t(rays)};
}

/// Adds the rays of lumel i.
void LinkTracer::add(std::uint32_t i, const Sending& sending, RayBatch& wave) const
{
    const std::uint32_t rays = work_.is_buried(i) ? 0u : sending.rays[i];
    const LumelSamples own = samples_of(i, sending.round, sending.solution, rays);
    std::optional<CosineDraw> shared;
    if (sending.shared)
        shared.emplace(*sending.shared);
    const std::span<const LinkEnd> known =
        sending.known ? sending.known->of(i, rays) : std::span<const LinkEnd>();
    std::optional<GuidedDraw> draw;
    if (sending.guide && sending.round > 0)
        draw.emplace(sending.guide->of(i, sending.solution).probabilities);
    std::optional<SeenCells> seen;  // made for the first ray that needs it
    glm::vec3 axis(0.0f);
    glm::mat3 frame(0.0f);
    for (std::uint32_t k = 0; k < rays; ++k) {
        const PathSamples samples = own[k];
        std::optional<GuidedDraw::Drawn> drawn;
        if (sending.guide) {
            const glm::vec2 uniform = samples.stratified(kLinkDirectionPair);
            drawn = draw ? (*draw)(uniform) : GuidedDraw::Drawn{uniform, RayGuide::bin_of(uniform)};
            wave.bins.push_back(std::uint8_t(drawn->bin));
        }
        std::optional<LinkEnd> end = known.empty() ? std::nullopt : still(known[k], *sending.known);
        const bool is_sky = end && end->number() == LinkNumbers::kSky;
        if (end && !parts_.has_hidden(i) && !is_sky && sending.known->changes.moved.empty()) {
            wave.ends.push_back(*end);
            wave.from.push_back(0);
            continue;
        }
        const RayOrigin start = work_.starts.start(i, samples.stratified(kOriginPair));
        if (parts_.has_hidden(i) && !seen)
            seen.emplace(parts_.seen_cells(i));
        const std::uint32_t cell =
            seen ? seen->nearest({start.position, start.normal}) : start.cell;
        std::uint32_t along = 0;
        glm::vec3 direction;
        if (shared) {
            along = shared->draw(start.normal, samples.stratified(kLinkDirectionPair).x);
            direction = sending.shared->all()[along];
        } else {
            if (start.normal != axis) {
                axis = start.normal;
                frame = frame_about(axis);
            }
            direction =
                frame * by_cosine(drawn ? drawn->point : samples.stratified(kLinkDirectionPair));
        }
        if (start.cosine(direction) > 0.0f) {
            const RaySpan ray = ray_out(start.position, direction, samples.bits(kPassPair));
            if (end && may_meet_moved(ray, sending.known->changes))
                end.reset();
            if (!end) {
                wave.of.push_back(std::uint32_t(wave.ends.size()));
                wave.rays.push_back(ray);
                wave.along.push_back(along);
            } else if (is_sky) {
                wave.sky.push_back(
                    {std::uint32_t(wave.ends.size()), kPi * work_.sources.dim_sky(direction)});
            }
        }
        wave.ends.push_back(end ? *end : LinkEnd::of(LinkNumbers::kBelow));
        wave.from.push_back(std::uint8_t(cell));
    }
    wave.lumels.push_back(i);
    wave.samples.push_back(own);
    wave.slots_before.push_back(std::uint32_t(wave.ends.size()));
}

/// Traces the first rays of several batches together.
void LinkTracer::cast_bundles(const SharedDirections& shared, std::vector<RayBatch>& waves) const
{
    std::vector<std::uint32_t> along;
    std::vector<RaySpan> rays;
    for (const RayBatch& wave : waves) {
        along.insert(along.end(), wave.along.begin(), wave.along.end());
        rays.insert(rays.end(), wave.rays.begin(), wave.rays.end());
    }
    std::vector<RayHit> hits(rays.size());
    work_.casters.bundles->closest({shared.all(), along, rays}, hits);
    auto next = hits.begin();
    for (RayBatch& wave : waves) {
        const auto end = next + std::ptrdiff_t(wave.rays.size());
        wave.hits.assign(next, end);
        wave.is_cast = true;
        next = end;
    }
}

void LinkTracer::follow(RayBatch& wave) const
{
    wave.first_rays = std::uint32_t(wave.rays.size());
    for (int reflections = 0; !wave.rays.empty(); ++reflections) {
        const std::size_t count = wave.rays.size();
        wave.hits.resize(std::max(wave.hits.size(), count));
        const RayCaster& caster = reflections > 0 ? work_.caster_of_few() : work_.caster();
        if (reflections > 0 || !wave.is_cast)
            caster.closest(wave.rays, std::span(wave.hits).first(count));
        wave.arrivals.clear();
        find_landings(wave);
        if (reflections == 0)
            meet_first(wave);
        else
            meet(wave, reflections);
        find_seen_cells(wave, reflections);
        end_or_reflect(wave, reflections);
    }
}

/// Finds where the rays of a batch land. Looks up the lumels of all hits before their cells and
/// sizes, so that memory reads overlap.
void LinkTracer::find_landings(RayBatch& wave) const
{
    const std::span hits = std::span(wave.hits).first(wave.rays.size());
    hits_.find(hits, wave.met);
    wave.landings.resize(hits.size());
    for (std::size_t r = 0; r < hits.size(); ++r)
        wave.landings[r] = landing_of(wave.rays[r], hits[r], wave.met[r]);
}

LinkTracer::Landing LinkTracer::landing_of(const RaySpan& ray, const RayHit& hit,
                                           std::uint32_t j) const
{
    if (hit.distance == RayCaster::kNothing)
        return {.end = LinkNumbers::kSky};
    if (!hit.front) {
        const std::size_t surface = work_.scene.surfaces.index(hit.instance, hit.primitive);
        if (!work_.scene.surfaces.all()[surface].double_sided)
            return {.end = numbers_.black_on(hit.instance)};
    }
    if (j == kNoLumel)
        return {.end = numbers_.lost_on(hit.instance)};
    const glm::vec3 position = ray.origin + hit.distance * ray.direction;
    return {.lumel = j,
            .cell = work_.cells.cell(j, position),
            .size = work_.world[j].size,
            .position = position};
}

/// Ends far rays at their first hit, and begins the paths of the others.
void LinkTracer::meet_first(RayBatch& wave) const
{
    std::size_t n = 0;
    for (std::uint32_t r = 0; r < wave.rays.size(); ++r) {
        const std::uint32_t slot = wave.of[r];
        while (slot >= wave.slots_before[n + 1])
            ++n;
        const RaySpan& ray = wave.rays[r];
        const RayHit& hit = wave.hits[r];
        const float size = work_.world[wave.lumels[n]].size;
        const Landing& at = wave.landings[r];
        const bool is_lumel = at.lumel != kNoLumel;
        const float sides = hit.distance / std::max(size, at.size);
        if (hit.tint == glm::vec3(1.0f)) {
            if (is_lumel ? sides >= kNearSides && !parts_.is_detailed(at.lumel)
                         : hit.distance >= kNearSides * size) {
                wave.ends[slot] =
                    is_lumel ? LinkEnd::of(numbers_.of_part(parts_.first(at.lumel)), at.cell)
                             : LinkEnd::of(at.end);
                if (!is_lumel && at.end == LinkNumbers::kSky)
                    wave.sky.push_back({slot, kPi * work_.sources.dim_sky(ray.direction)});
                continue;
            }
        }
        const auto path = std::uint32_t(wave.paths.size());
        wave.paths.push_back(
            {.samples = wave.samples[n][slot - wave.slots_before[n]],
             .slot = slot,
             .size = size,
             .weight = hit.tint,
             .distance = at.end == LinkNumbers::kSky ? NearLight::kNoHit : hit.distance,
             .end = LinkEnd::of(at.end)});
        if (is_lumel) {
            const bool half = parts_.is_half_covered(at.lumel);
            const float near_for_light = direct_.varies(at.lumel) ? kNearSides : kNearForCells;
            wave.arrivals.push_back(
                {.ray = r,
                 .path = path,
                 .lumel = at.lumel,
                 .cell = at.cell,
                 .position = at.position,
                 .may_be_hidden = parts_.has_hidden(at.lumel) || sides < kMayBeHidden,
                 .looks_around = half || sides < near_for_light,
                 .goes_on = half || sides < kNearSides});
        } else if (at.end == LinkNumbers::kSky)
            add_sky(wave, path, ray);
    }
}

/// Stores the results of a batch, whose lumels are those of work_.order from `first` on.
void LinkTracer::keep(RayBatch& wave, std::size_t first, LinkTable& into) const
{
    for (const Path& path : wave.paths)
        wave.ends[path.slot] = path.is_straight && path.weight == glm::vec3(1.0f) &&
                                       numbers_.is_part(path.end.number())
                                   ? path.end
                                   : LinkEnd::of(LinkNumbers::kNear);
    const auto by_slot = [](const SkyRay& a, const SkyRay& b) { return a.slot < b.slot; };
    if (!std::is_sorted(wave.sky.begin(), wave.sky.end(), by_slot))
        std::sort(wave.sky.begin(), wave.sky.end(), by_slot);
    std::ranges::stable_sort(wave.shares, {}, &PathShare::path);
    into.rounds.back()[first / kLinkBlock].traced += wave.first_rays;
    auto sky = wave.sky.begin();
    auto path = wave.paths.begin();
    auto share = wave.shares.begin();
    for (std::size_t n = 0; n < wave.lumels.size(); ++n) {
        LinkBlock& block = into.rounds.back()[(first + n) / kLinkBlock];
        const std::uint32_t i = wave.lumels[n], begin = wave.slots_before[n],
                            end = wave.slots_before[n + 1];
        const auto in_block = [&](std::uint32_t slot) {
            return std::uint32_t(block.ends.size()) + slot - begin;
        };
        for (; path != wave.paths.end() && path->slot < end; ++path) {
            const bool is_near = wave.ends[path->slot].number() == LinkNumbers::kNear;
            for (; share != wave.shares.end() &&
                   share->path == std::uint32_t(path - wave.paths.begin());
                 ++share)
                if (is_near)
                    block.shares.push_back(
                        {std::uint32_t(block.near.size()), share->lamp, share->at, share->light});
            if (is_near) {
                block.near.push_back(
                    {in_block(path->slot), path->end, glm::packF3x9_E1x5(path->weight)});
                block.near_light.push_back({path->distance, path->light});
            }
        }
        for (; sky != wave.sky.end() && sky->slot < end; ++sky)
            into.sky[parts_.part(i, wave.from[sky->slot])] += sky->light;
        if (parts_.has_hidden(i))
            block.from.insert(block.from.end(), wave.from.begin() + begin, wave.from.begin() + end);
        if (!wave.bins.empty())
            block.bins.insert(block.bins.end(), wave.bins.begin() + begin, wave.bins.begin() + end);
        block.rays.push_back(std::uint16_t(end - begin));
        block.ends.insert(block.ends.end(), wave.ends.begin() + begin, wave.ends.begin() + end);
    }
}

void LinkTracer::trace_blocks(std::size_t first, std::size_t last, const Sending& sending,
                              LinkTable& into) const
{
    const std::size_t end = std::min(last * kLinkBlock, work_.order.size());
    RayBatch wave;
    for (std::size_t o = first * kLinkBlock; o < end; ++o) {
        add(work_.order[o], sending, wave);
        if (wave.ends.size() < work_.caster().batch() && o + 1 < end)
            continue;
        follow(wave);
        keep(wave, o + 1 - wave.lumels.size(), into);
        wave.begin();
    }
}

/// Traces by bundles: one drawing serves all blocks.
void LinkTracer::trace_bundles(std::size_t first, std::size_t last, const Sending& sending,
                               LinkTable& into) const
{
    std::vector<RayBatch> waves(last - first);
    const auto for_each_wave = [&](const auto& what) {
        parallel_for(waves.size(), 1, [&](std::size_t from, std::size_t to) {
            for (std::size_t w = from; w < to; ++w)
                what(waves[w], (first + w) * kLinkBlock);
        });
    };
    for_each_wave([&](RayBatch& wave, std::size_t begin) {
        for (std::size_t o = begin; o < std::min(begin + kLinkBlock, work_.order.size()); ++o)
            add(work_.order[o], sending, wave);
    });
    cast_bundles(*sending.shared, waves);
    for_each_wave([&](RayBatch& wave, std::size_t begin) {
        follow(wave);
        keep(wave, begin, into);
    });
}

void LinkTracer::trace(std::size_t first, std::size_t last, const Sending& sending,
                       LinkTable& into) const
{
    if (sending.shared && work_.casters.bundles) {
        trace_bundles(first, last, sending, into);
    } else {
        const std::size_t end = std::min(last * kLinkBlock, work_.order.size());
        std::size_t all = 1;
        for (std::size_t o = first * kLinkBlock; o < end; ++o)
            all += sending.rays[work_.order[o]];
        const std::size_t grain = work_.caster().batch() * (last - first) / all;
        parallel_for_own(work_.ranks, first, last, grain, [&](std::size_t from, std::size_t to) {
            trace_blocks(from, to, sending, into);
        });
    }
    for (std::size_t b = first; b < last; ++b) {
        LinkBlock& block = into.rounds.back()[b];
        if (!is_own(work_.ranks, b)) {
            block = {};  // of bundles, which each rank traces for all
            continue;
        }
        block.ends.shrink_to_fit();
        block.from.shrink_to_fit();
        block.near.shrink_to_fit();
        block.near_light.shrink_to_fit();
        block.shares.shrink_to_fit();
        block.bins.shrink_to_fit();
    }
}

}  // namespace lumel
