#include "links/trace/tracer.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include <glm/gtc/packing.hpp>

#include "base/core/frame.h"
#include "base/core/parallel.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"

namespace lumel {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();

/// A hit closer than this many sides of the larger lumel is reflected again, with shadow rays at
/// the hit: neither cells nor sub-lumels resolve such small distances.
constexpr float kTooNear = 0.25f;
/// A first hit closer than kNear is reflected too: near corners indirect light changes within a
/// lumel, but is stored per sub-lumel only. It gets shadow rays if closer than kNearForCells, or if
/// direct light varies within the lumel; otherwise the lumel's has less noise.
constexpr float kNear = 2.0f, kNearForCells = 1.0f;
/// Hits closer than this many sides can be on a sliver that the lumel's cells do not represent, as
/// in a gap between two walls: light is looked up in a cell visible from the hit, or not at all.
constexpr float kMayBeHidden = 1.0f;
/// Maximum number of such reflections.
constexpr int kMaxReflections = 8;
/// Height of visibility rays to cells above the surface, in sides of the lumel.
constexpr float kAboveHit = 0.05f;

/// Dimension pairs of a ray's random numbers; each reflection uses kPerReflection more.
constexpr std::uint32_t kOriginPair = 0, kDirectionPair = 1, kPassPair = 2, kFirstReflection = 3,
                        kPerReflection = 2;

}  // namespace

/// A ray from a lumel with its reflections: gathered light and remaining weight.
struct LinkTracer::Path {
    PathSamples samples;
    std::uint32_t from;  ///< sub-lumel of origin
    float size;          ///< size of the last lumel on the path [m]
    glm::vec3 weight{1.0f};
    glm::vec3 reflected{0.0f};  ///< reflected by surfaces [lx]
    glm::vec3 sky{0.0f};        ///< [lx]
    HitKind met = HitKind::nothing;
    std::uint32_t part = 0;  ///< sub-lumel that it hit
    float nearest = kFar;    ///< distance to the first hit [m]
};

/// A ray's hit on a lumel.
struct LinkTracer::PathHit {
    std::uint32_t ray;  ///< ray of the batch
    std::uint32_t lumel, cell;
    glm::vec3 position;              ///< [m]
    bool may_be_hidden;              ///< the hit may be occluded from the lumel's cells
    bool looks_around;               ///< traces shadow rays instead of using a cell
    bool goes_on;                    ///< is reflected there
    bool is_hidden = false;          ///< no cell is visible
    std::uint32_t unseen_cells = 0;  ///< bit c: cell c was tested, and is occluded
};

/// Paths traced together, one reflection at a time.
struct LinkTracer::RayBatch {
    std::vector<std::uint32_t> lumels;
    std::vector<std::uint32_t> paths_before;  ///< [lumels + 1]
    std::vector<Path> paths;                  ///< grouped by lumel

    // Paths that have not ended.
    int reflections = 0;
    std::vector<RaySpan> rays;
    std::vector<std::uint32_t> path_of;  ///< [rays]
    std::vector<RayHit> hits;            ///< [rays or more]
    std::vector<std::uint32_t> along;    ///< [rays] shared direction, for first rays
    bool is_cast = false;                ///< hits of first rays are known
    std::vector<PathHit> arrivals;

    // One reflection; members to reuse their memory.
    std::vector<std::uint32_t> open;  ///< hits that need a visible cell
    std::vector<RaySpan> to_cells;
    std::vector<glm::vec3> transmittance;  ///< [to_cells]
    ShadowRays looks;
    std::vector<RaySpan> next_rays;
    std::vector<std::uint32_t> next_path_of;  ///< [next_rays]
    std::vector<std::uint32_t> looking;       ///< paths with shadow rays

    RayBatch() { begin(); }
    void begin()
    {
        lumels.clear();
        paths_before.assign(1, 0);
        paths.clear();
        rays.clear();
        path_of.clear();
        along.clear();
    }
};

bool LinkSet::is_closed() const
{
    return std::none_of(rounds.begin(), rounds.end(), [](const std::vector<LinkBlock>& blocks) {
        return std::any_of(blocks.begin(), blocks.end(),
                           [](const LinkBlock& block) { return block.loses; });
    });
}

std::size_t LinkSet::bytes() const
{
    std::size_t bytes = 0;
    for (const std::vector<LinkBlock>& blocks : rounds)
        for (const LinkBlock& block : blocks)
            bytes += (block.first.size() + block.target.size() + block.first_weak.size()) *
                         sizeof(std::uint32_t) +
                     block.weak.size() * sizeof(AttenuatedLink);
    return bytes;
}

LinkTracer::LinkTracer(const LinkWork& work, const SubLumels& parts, const DirectEstimator& direct,
                       std::uint32_t seed)
    : work_(work),
      parts_(parts),
      direct_(direct),
      hits_(work.scene.scene, work.scene.atlas, work.scene.lumels),
      seed_(seed),
      ray_offset_(work.scene.rays.ray_offset())
{
}

void LinkTracer::add(std::uint32_t i, const Sending& sending, RayBatch& wave) const
{
    const Lumel& lumel = work_.lumels()[i];
    const std::uint32_t rays = (lumel.flags & kLumelBuried) != 0 ? 0u : sending.rays[i];
    const std::uint32_t own = PathSamples::hash(PathSamples::hash(seed_, sending.stream), i);
    std::optional<CosineDraw> shared;
    if (sending.shared) {
        const auto width = std::uint32_t(work_.scene.lumels.width);
        shared.emplace(*sending.shared,
                       sending.shared->set(lumel.texel % width, lumel.texel / width));
    }
    for (std::uint32_t k = 0; k < rays; ++k) {
        const PathSamples samples(own, k);
        const RayOrigin start = work_.starts.start(i, samples.stratified(kOriginPair));
        std::uint32_t along = 0;
        glm::vec3 direction;
        if (shared) {
            const float at = (float(k) + samples.random(kDirectionPair).x) / float(rays);
            along = shared->draw(start.normal, at);
            direction = sending.shared->all()[along];
        } else {
            direction = frame_about(start.normal) * by_cosine(samples.stratified(kDirectionPair));
        }
        if (start.cosine(direction) > 0.0f) {
            wave.path_of.push_back(std::uint32_t(wave.paths.size()));
            wave.rays.push_back(ray_out(start.position, direction, samples.bits(kPassPair)));
            wave.along.push_back(along);
        }
        wave.paths.push_back(
            {.samples = samples, .from = parts_.part(i, start.cell), .size = work_.world[i].size});
    }
    wave.lumels.push_back(i);
    wave.paths_before.push_back(std::uint32_t(wave.paths.size()));
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
    for (wave.reflections = 0; !wave.rays.empty(); ++wave.reflections) {
        const std::size_t count = wave.rays.size();
        wave.hits.resize(std::max(wave.hits.size(), count));
        if (wave.reflections > 0 || !wave.is_cast)
            work_.caster().closest(wave.rays, std::span(wave.hits).first(count));
        meet(wave);
        find_seen_cells(wave);
        end_or_reflect(wave);
    }
}

/// Ends paths that hit no lumel; makes a PathHit of the others.
void LinkTracer::meet(RayBatch& wave) const
{
    wave.arrivals.clear();
    for (std::uint32_t r = 0; r < wave.rays.size(); ++r) {
        const RaySpan& ray = wave.rays[r];
        const RayHit& hit = wave.hits[r];
        Path& path = wave.paths[wave.path_of[r]];
        path.weight *= hit.tint;
        if (hit.distance == RayCaster::kNothing) {
            (wave.reflections == 0 ? path.sky : path.reflected) +=
                path.weight * kPi * work_.sources.dim_sky(ray.direction);
            path.met = HitKind::sky;
            continue;
        }
        if (wave.reflections == 0)
            path.nearest = hit.distance;
        path.met = HitKind::nothing;
        const std::size_t surface = work_.scene.surfaces.index(hit.instance, hit.primitive);
        if (!hit.front && !work_.scene.surfaces.all()[surface].double_sided)
            continue;
        const std::uint32_t j = hits_.lumel(hit);
        if (j == kNoLumel) {
            path.met = HitKind::lost;
            continue;
        }
        const glm::vec3 position = ray.origin + hit.distance * ray.direction;
        const float sides = hit.distance / std::max(path.size, work_.lumels()[j].size);
        const bool may_go_on = wave.reflections < kMaxReflections, first = wave.reflections == 0;
        const float near_for_light = direct_.varies(j) ? kNear : kNearForCells;
        wave.arrivals.push_back(
            {.ray = r,
             .lumel = j,
             .cell = work_.cells.cell(j, position),
             .position = position,
             .may_be_hidden = parts_.is_cut(j) || sides < kMayBeHidden,
             .looks_around = may_go_on && sides < (first ? near_for_light : kTooNear),
             .goes_on = may_go_on && sides < (first ? kNear : kTooNear)});
    }
}

/// For hits that may be occluded from their cell, finds the nearest visible cell of the lumel.
/// Paths without one are reflected, up to the maximum.
void LinkTracer::find_seen_cells(RayBatch& wave) const
{
    std::vector<std::uint32_t>& open = wave.open;
    open.clear();
    for (std::uint32_t a = 0; a < wave.arrivals.size(); ++a)
        if (!wave.arrivals[a].looks_around && wave.arrivals[a].may_be_hidden)
            open.push_back(a);
    while (!open.empty()) {
        // One ray for each hit with an untested cell.
        wave.to_cells.clear();
        std::erase_if(open, [&](std::uint32_t a) {
            PathHit& arrival = wave.arrivals[a];
            const std::optional<RaySpan> ray = ray_to_cell(arrival, wave.rays[arrival.ray].seed);
            if (ray) {
                wave.to_cells.push_back(*ray);
                return false;
            }
            arrival.is_hidden = true;
            arrival.goes_on = arrival.looks_around = wave.reflections < kMaxReflections;
            return true;
        });
        wave.transmittance.resize(wave.to_cells.size());
        work_.caster().transmittance(wave.to_cells, wave.transmittance);
        auto passed = wave.transmittance.begin();
        std::erase_if(open, [&](std::uint32_t a) {
            const bool sees = *passed++ != glm::vec3(0.0f);
            if (!sees)
                wave.arrivals[a].unseen_cells |= 1u << wave.arrivals[a].cell;
            return sees;
        });
    }
}

/// Ray to the nearest cell not known to be occluded, which becomes the hit's cell; empty if there
/// is none.
std::optional<RaySpan> LinkTracer::ray_to_cell(PathHit& arrival, std::uint32_t seed) const
{
    const std::uint32_t j = arrival.lumel;
    const CellPoints points = cell_points(work_.world, work_.cells, j);
    const std::uint32_t left = points.used & ~arrival.unseen_cells;
    if (left == 0)
        return std::nullopt;
    float least = kFar;
    for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c) {
        const glm::vec3 apart = points.point[c].position - arrival.position;
        if ((left >> c & 1u) != 0 && glm::dot(apart, apart) < least) {
            least = glm::dot(apart, apart);
            arrival.cell = c;
        }
    }
    const float ray_offset = std::max(kAboveHit * work_.world[j].size, ray_offset_);
    const LumelPoint& point = points.point[arrival.cell];
    return ray_between(arrival.position + ray_offset * work_.world[j].normal,
                       point.position + ray_offset * point.normal, 0.0f, seed);
}

/// Ends paths at the sub-lumels that they hit, or reflects them.
void LinkTracer::end_or_reflect(RayBatch& wave) const
{
    wave.next_rays.clear();
    wave.next_path_of.clear();
    wave.looking.clear();
    wave.looks.clear();
    for (const PathHit& arrival : wave.arrivals) {
        const std::uint32_t p = wave.path_of[arrival.ray];
        Path& path = wave.paths[p];
        const glm::vec3& albedo = work_.lumels()[arrival.lumel].albedo;
        if (arrival.is_hidden && !arrival.goes_on)
            continue;
        if (!arrival.looks_around)
            path.reflected += path.weight * albedo * direct_.at(arrival.lumel, arrival.cell);
        if (!arrival.goes_on) {
            path.part = parts_.part(arrival.lumel, arrival.cell);
            path.met = HitKind::part;
            continue;
        }
        path.weight *= albedo;
        if (path.weight == glm::vec3(0.0f))
            continue;
        wave.next_rays.push_back(reflect(wave, arrival, path, wave.looks));
        wave.next_path_of.push_back(p);
        if (arrival.looks_around)
            wave.looking.push_back(p);
    }
    wave.looks.cast(work_.caster());
    for (std::uint32_t n = 0; n < wave.looking.size(); ++n) {
        Path& path = wave.paths[wave.looking[n]];
        path.reflected += path.weight * direct_.light_of(wave.looks, n * direct_.looks_around());
    }
    wave.rays.swap(wave.next_rays);
    wave.path_of.swap(wave.next_path_of);
}

/// Queues the hit's shadow rays, if it has any, and returns the reflected ray.
RaySpan LinkTracer::reflect(const RayBatch& wave, const PathHit& arrival, Path& path,
                            ShadowRays& looks) const
{
    const RaySpan& ray = wave.rays[arrival.ray];
    const RayHit& hit = wave.hits[arrival.ray];
    const auto pair_of = [](int reflections) {
        return kFirstReflection + std::uint32_t(reflections) * kPerReflection;
    };
    const std::uint32_t pair = pair_of(wave.reflections);
    const glm::vec3 normal = hit.front ? hit.normal : -hit.normal;
    const glm::vec3 origin = ray.origin +
                             ray.direction * std::max(0.0f, hit.distance - ray_offset_) +
                             ray_offset_ * normal;
    path.size = work_.lumels()[arrival.lumel].size;
    if (arrival.looks_around)
        direct_.sample_lights({origin, normal, normal, arrival.cell}, path.size,
                              path.samples.bits(pair), looks);
    return ray_out(origin, frame_about(normal) * by_cosine(path.samples.random(pair + 1)),
                   path.samples.bits(pair_of(wave.reflections + 1)));
}

/// Stores the results of one lumel's paths.
void LinkTracer::keep(const RayBatch& wave, std::size_t n, LinkBlock& block, LinkSet& into) const
{
    const std::uint32_t first = parts_.first(wave.lumels[n]);
    const std::uint32_t parts = parts_.end(wave.lumels[n]) - first;
    const std::span<const Path> paths =
        std::span(wave.paths)
            .subspan(wave.paths_before[n], wave.paths_before[n + 1] - wave.paths_before[n]);
    for (const Path& path : paths) {
        into.nearest[path.from] = std::min(into.nearest[path.from], path.nearest);
        block.loses = block.loses || path.met != HitKind::part;
        if (path.met == HitKind::lost)
            continue;
        ++into.rays[path.from];
        into.reflected[path.from] += path.reflected;
        into.sky[path.from] += path.sky;
    }
    for (std::uint32_t p = first; p < first + parts; ++p) {
        for (const Path& path : paths) {
            if (path.from != p || path.met != HitKind::part)
                continue;
            if (path.weight == glm::vec3(1.0f))
                block.target.push_back(path.part);
            else
                block.weak.push_back({path.part, glm::packF3x9_E1x5(path.weight)});
        }
        block.first.push_back(std::uint32_t(block.target.size()));
        block.first_weak.push_back(std::uint32_t(block.weak.size()));
    }
}

/// Stores the results of a batch, whose lumels are those of work_.order from `first` on.
void LinkTracer::keep_all(const RayBatch& wave, std::size_t first, LinkSet& into) const
{
    for (std::size_t n = 0; n < wave.lumels.size(); ++n) {
        LinkBlock& block = into.rounds.back()[(first + n) / kLinkBlock];
        if (block.first.empty()) {
            block.first.push_back(0);
            block.first_weak.push_back(0);
        }
        keep(wave, n, block, into);
    }
}

void LinkTracer::trace_blocks(std::size_t first, std::size_t last, const Sending& sending,
                              LinkSet& into) const
{
    const std::size_t end = std::min(last * kLinkBlock, work_.order.size());
    RayBatch wave;
    for (std::size_t o = first * kLinkBlock; o < end; ++o) {
        add(work_.order[o], sending, wave);
        if (wave.paths.size() < work_.caster().batch() && o + 1 < end)
            continue;
        follow(wave);
        keep_all(wave, o + 1 - wave.lumels.size(), into);
        wave.begin();
    }
}

/// Traces by bundles: one drawing serves all blocks.
void LinkTracer::trace_bundles(std::size_t first, std::size_t last, const Sending& sending,
                               LinkSet& into) const
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
        keep_all(wave, begin, into);
    });
}

void LinkTracer::trace(std::size_t first, std::size_t last, const Sending& sending,
                       LinkSet& into) const
{
    if (sending.shared && work_.casters.bundles) {
        trace_bundles(first, last, sending, into);
    } else {
        const std::size_t end = std::min(last * kLinkBlock, work_.order.size());
        std::size_t all = 1;
        for (std::size_t o = first * kLinkBlock; o < end; ++o)
            all += sending.rays[work_.order[o]];
        const std::size_t grain = work_.caster().batch() * (last - first) / all;
        parallel_for(last - first, grain, [&](std::size_t from, std::size_t to) {
            trace_blocks(first + from, first + to, sending, into);
        });
    }
    for (std::size_t b = first; b < last; ++b) {
        LinkBlock& block = into.rounds.back()[b];
        block.first.shrink_to_fit();
        block.target.shrink_to_fit();
        block.first_weak.shrink_to_fit();
        block.weak.shrink_to_fit();
    }
}

}  // namespace lumel
