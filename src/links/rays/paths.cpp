// LinkTracer's paths: rays that need more than their first hit, one reflection at a time.

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "base/core/frame.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"
#include "links/rays/ray_batch.h"

namespace lumel {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();

/// A hit closer than this many sides of the larger lumel is reflected again, with shadow rays at
/// the hit: neither cells nor sub-lumels resolve such small distances.
constexpr float kTooNear = 0.25f;
/// Maximum number of such reflections.
constexpr int kMaxReflections = 8;
/// Height of visibility rays to cells above the surface, in sides of the lumel.
constexpr float kAboveHit = 0.05f;

/// First dimension pair of a reflection, and in it that of the Russian roulette.
std::uint32_t pair_of(int reflections)
{
    return kFirstReflection + std::uint32_t(reflections) * kPerReflection;
}
constexpr std::uint32_t kRoulettePair = 2;
/// Brighter surfaces end no path: it would save little, and light that is reflected for long would
/// amplify its noise.
constexpr float kBrightestAbsorbing = 0.9f;

}  // namespace

/// Adds the light of the sky at the end of a path.
void LinkTracer::add_sky(RayBatch& wave, std::uint32_t path, const RaySpan& ray) const
{
    const glm::vec3 light = wave.paths[path].weight * kPi * work_.sources.dim_sky(ray.direction);
    wave.paths[path].light += light;
    if (lamps_)
        wave.shares.push_back({path, lamps_->of_dim_sky, {}, light});
}

/// Ends reflected paths that hit no lumel; makes a PathHit of the others.
void LinkTracer::meet(RayBatch& wave, int reflections) const
{
    for (std::uint32_t r = 0; r < wave.rays.size(); ++r) {
        const RaySpan& ray = wave.rays[r];
        const RayHit& hit = wave.hits[r];
        Path& path = wave.paths[wave.of[r]];
        path.weight *= hit.tint;
        const Landing& at = wave.landings[r];
        if (at.lumel == kNoLumel) {
            path.end = LinkEnd::of(at.end);
            if (at.end == LinkNumbers::kSky)
                add_sky(wave, wave.of[r], ray);
            continue;
        }
        const float sides = hit.distance / std::max(path.size, at.size);
        const bool is_near =
            reflections < kMaxReflections && (sides < kTooNear || parts_.is_half_covered(at.lumel));
        wave.arrivals.push_back(
            {.ray = r,
             .path = wave.of[r],
             .lumel = at.lumel,
             .cell = at.cell,
             .position = at.position,
             .may_be_hidden = parts_.has_hidden(at.lumel) || sides < kMayBeHidden,
             .looks_around = is_near,
             .goes_on = is_near});
    }
}

/// For hits that may be occluded from their cell, finds the nearest visible cell of the lumel.
/// Paths without one are reflected, up to the maximum.
void LinkTracer::find_seen_cells(RayBatch& wave, int reflections) const
{
    std::vector<std::uint32_t>& open = wave.open;
    open.clear();
    for (std::uint32_t a = 0; a < wave.arrivals.size(); ++a)
        if (!wave.arrivals[a].looks_around && wave.arrivals[a].may_be_hidden)
            open.push_back(a);
    // By lumel, so that the points of its cells are found once.
    std::ranges::sort(open, {},
                      [&](std::uint32_t a) { return std::pair(wave.arrivals[a].lumel, a); });
    while (!open.empty()) {
        // One ray for each hit with an untested cell.
        wave.to_cells.clear();
        std::uint32_t of = kNoLumel;
        CellPoints points;
        std::erase_if(open, [&](std::uint32_t a) {
            PathHit& arrival = wave.arrivals[a];
            if (arrival.lumel != of) {
                of = arrival.lumel;
                points = cell_points(work_.world, work_.cells, of);
            }
            const std::optional<RaySpan> ray =
                ray_to_cell(arrival, points, wave.rays[arrival.ray].seed);
            if (ray) {
                wave.to_cells.push_back(*ray);
                return false;
            }
            arrival.is_hidden = true;
            arrival.goes_on = arrival.looks_around = reflections < kMaxReflections;
            return true;
        });
        wave.transmittance.resize(wave.to_cells.size());
        work_.caster_of_few().transmittance(wave.to_cells, wave.transmittance);
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
/// is none. points: of the lumel's cells.
std::optional<RaySpan> LinkTracer::ray_to_cell(PathHit& arrival, const CellPoints& points,
                                               std::uint32_t seed) const
{
    const std::uint32_t j = arrival.lumel;
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
    const float ray_offset =
        std::max(kAboveHit * work_.world[j].size, ray_offset_for(work_.world[j].reach));
    const LumelPoint& point = points.point[arrival.cell];
    return ray_between(arrival.position + ray_offset * work_.world[j].normal,
                       point.position + ray_offset * point.normal, 0.0f, seed);
}

/// 1 / probability of going on, or 0: Russian roulette by the albedo. The first reflection always
/// goes on, as most of a path's light is from there, and bright surfaces reflect all.
float LinkTracer::survival(const Path& path, const glm::vec3& albedo, int reflections)
{
    const float goes_on = std::max({albedo.r, albedo.g, albedo.b});
    if (reflections == 0 || goes_on > kBrightestAbsorbing)
        return 1.0f;
    const float at = path.samples.random(pair_of(reflections) + kRoulettePair).x;
    return at < goes_on ? 1.0f / goes_on : 0.0f;
}

/// Ends paths at the sub-lumels that they hit, or reflects them.
void LinkTracer::end_or_reflect(RayBatch& wave, int reflections) const
{
    wave.next_rays.clear();
    wave.next_of.clear();
    wave.looking.clear();
    wave.looks.clear();
    for (const PathHit& arrival : wave.arrivals) {
        Path& path = wave.paths[arrival.path];
        const glm::vec3& albedo = work_.lumels()[arrival.lumel].albedo;
        path.end = LinkEnd::of(LinkNumbers::kBelow);
        if (arrival.is_hidden && !arrival.goes_on)
            continue;
        if (!arrival.looks_around)
            path.light += path.weight * albedo * direct_.at(arrival.lumel, arrival.cell);
        if (lamps_ && (!arrival.looks_around || outside_light_))
            wave.shares.push_back(
                {arrival.path, NearShare::kEveryLamp,
                 LinkEnd::of(numbers_.of_part(parts_.part(arrival.lumel, arrival.cell)),
                             arrival.cell),
                 path.weight});
        if (!arrival.goes_on) {
            path.end = LinkEnd::of(numbers_.of_part(parts_.part(arrival.lumel, arrival.cell)),
                                   arrival.cell);
            continue;
        }
        path.is_straight = false;
        path.weight *= albedo * survival(path, albedo, reflections);
        if (path.weight == glm::vec3(0.0f))
            continue;
        wave.next_rays.push_back(reflect(wave, arrival, reflections, path, wave.looks));
        wave.next_of.push_back(arrival.path);
        if (arrival.looks_around)
            wave.looking.push_back(arrival.path);
    }
    wave.looks.cast(work_.caster_of_few());
    for (std::uint32_t n = 0; n < wave.looking.size(); ++n) {
        Path& path = wave.paths[wave.looking[n]];
        const std::uint32_t first = n * direct_.looks_around();
        path.light += path.weight * direct_.light_of(wave.looks, first);
        for (std::uint32_t look = first; lamps_ && look < first + direct_.looks_around(); ++look)
            wave.shares.push_back({wave.looking[n],
                                   lamps_->of_source[wave.looks.sample(look).source],
                                   {},
                                   path.weight * wave.looks.transmittance(look) *
                                       wave.looks.sample(look).irradiance});
    }
    wave.rays.swap(wave.next_rays);
    wave.of.swap(wave.next_of);
}

/// Queues the hit's shadow rays, if it has any, and returns the reflected ray.
RaySpan LinkTracer::reflect(const RayBatch& wave, const PathHit& arrival, int reflections,
                            Path& path, ShadowRays& looks) const
{
    const RaySpan& ray = wave.rays[arrival.ray];
    const RayHit& hit = wave.hits[arrival.ray];
    const std::uint32_t pair = pair_of(reflections);
    const glm::vec3 normal = hit.front ? hit.normal : -hit.normal;
    const glm::vec3 origin = ray.origin +
                             ray.direction * std::max(0.0f, hit.distance - hit.ray_offset) +
                             hit.ray_offset * normal;
    path.size = work_.lumels()[arrival.lumel].size;
    if (arrival.looks_around)
        direct_.sample_lights({origin, normal, normal, arrival.cell}, path.size,
                              path.samples.bits(pair), looks);
    return ray_out(origin, frame_about(normal) * by_cosine(path.samples.random(pair + 1)),
                   path.samples.bits(pair_of(reflections + 1)));
}

}  // namespace lumel
