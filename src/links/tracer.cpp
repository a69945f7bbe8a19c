#include "links/tracer.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include <glm/gtc/packing.hpp>

#include "core/frame.h"
#include "core/parallel.h"
#include "core/sphere.h"

namespace lumel {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kFar = std::numeric_limits<float>::max();

/// A ray whose hit is nearer than this many sides of the larger lumel is reflected there once more
/// before it looks anything up, and direct light is seen for there: so near, neither the cells of a
/// lumel nor its parts are fine enough.
constexpr float kTooNear = 0.25f;
/// Within so many sides what is met may be a sliver of a lumel that its cells know nothing of, as
/// in a gap between two walls: light is looked up in a cell that sees it, or not at all.
constexpr float kMayBeHidden = 1.0f;
/// Reflections before that, at most.
constexpr int kMostReflections = 4;
/// Lookups are checked by rays this far above the surfaces, in sides of the lumel.
constexpr float kLift = 0.05f;
/// Texels around a hit without a lumel that are searched for one.
constexpr int kNeighbours = 2;

/// Dimension pairs of a ray's random numbers; each reflection has kPerReflection more.
constexpr std::uint32_t kStartPair = 0, kDirectionPair = 1, kPassPair = 2, kFirstReflection = 3,
                        kPerReflection = 2;

}  // namespace

/// What a ray has gathered, and what is left of it.
struct LinkTracer::Followed {
    glm::vec3 weight{1.0f};
    glm::vec3 reflected{0.0f};  ///< of surfaces met [lx]
    glm::vec3 sky{0.0f};        ///< [lx]
    std::uint32_t part = 0;
    float nearest = kFar;  ///< [m] to what it met first
};

bool Gathered::is_closed() const
{
    return std::none_of(rounds.begin(), rounds.end(), [](const std::vector<LinkBlock>& blocks) {
        return std::any_of(blocks.begin(), blocks.end(),
                           [](const LinkBlock& block) { return block.loses; });
    });
}

LinkTracer::LinkTracer(const LinkScene& place, const LightSources& sources,
                       const WorldLumels& world, const RayStarts& starts, const Cells& cells,
                       const LumelParts& parts, const DirectFinder& direct,
                       const std::vector<std::uint32_t>& order, std::uint32_t seed)
    : place_(place),
      sources_(sources),
      world_(world),
      starts_(starts),
      cells_(cells),
      parts_(parts),
      direct_(direct),
      order_(order),
      hits_(place.scene, place.atlas, place.lumels),
      by_side_(lumels_by_side(place.lumels)),
      seed_(seed),
      lift_(place.rays.lift())
{
}

/// The lumel at a hit, or where none is the nearest of its instance and side in the texels around:
/// rays that end in no lumel would darken a closed room without bound.
std::uint32_t LinkTracer::lumel_near(const RayHit& hit) const
{
    const std::vector<Lumel>& lumels = place_.lumels.lumels;
    const auto serves = [&](std::uint32_t j) {
        return j != kNoLumel && lumels[j].instance == hit.instance &&
               !(lumels[j].flags & kLumelBuried);
    };
    const std::uint32_t exact = hits_.lumel(hit);
    if (serves(exact))
        return exact;
    const glm::vec2 at = hits_.place(hit);
    const int width = place_.lumels.width, height = place_.lumels.height;
    std::uint32_t best = kNoLumel;
    float least = kFar;
    for (int dy = -kNeighbours; dy <= kNeighbours; ++dy)
        for (int dx = -kNeighbours; dx <= kNeighbours; ++dx) {
            const int x = int(at.x) + dx, y = int(at.y) + dy;
            if (x < 0 || x >= width || y < 0 || y >= height)
                continue;
            const std::uint32_t j =
                by_side_[2 * (std::size_t(y) * std::size_t(width) + std::size_t(x)) +
                         (hit.front ? 0 : 1)];
            const glm::vec2 apart = glm::vec2(x, y) + 0.5f - at;
            if (serves(j) && glm::dot(apart, apart) < least) {
                least = glm::dot(apart, apart);
                best = j;
            }
        }
    return best;
}

/// The cell whose point is nearest to a position among those that it sees. False: it sees none.
bool LinkTracer::seen_cell(std::uint32_t j, const glm::vec3& position, std::uint32_t seed,
                           std::uint32_t& cell) const
{
    CellPoints points = cell_points(world_, cells_, j);
    const float lift = std::max(kLift * world_[j].size, lift_);
    const glm::vec3 from = position + lift * world_[j].normal;
    while (points.used != 0) {
        float least = kFar;
        for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c) {
            const glm::vec3 apart = points.point[c].position - position;
            if (points.has(c) && glm::dot(apart, apart) < least) {
                least = glm::dot(apart, apart);
                cell = c;
            }
        }
        const LumelPoint& point = points.point[cell];
        if (place_.rays.sees(from, point.position + lift * point.normal, 0.0f, seed))
            return true;
        points.used &= ~(1u << cell);
    }
    return false;
}

LinkTracer::Met LinkTracer::follow(std::uint32_t i, const RayStart& start,
                                   const glm::vec3& first_direction, const PathSamples& samples,
                                   Followed& ray) const
{
    glm::vec3 origin = start.position, direction = first_direction;
    float size = world_[i].size;
    for (int reflections = 0;; ++reflections) {
        const std::uint32_t pair = kFirstReflection + std::uint32_t(reflections) * kPerReflection;
        const std::uint32_t seed = samples.bits(reflections == 0 ? kPassPair : pair);
        RayHit hit;
        const bool met = place_.rays.closest(origin, direction, 0.0f, kFar, seed, hit);
        ray.weight *= hit.tint;
        if (met && reflections == 0)
            ray.nearest = hit.distance;
        if (!met) {
            (reflections == 0 ? ray.sky : ray.reflected) +=
                ray.weight * kPi * sources_.rest_of_sky(direction);
            return Met::sky;
        }
        const std::size_t surface = place_.surfaces.index(hit.instance, hit.primitive);
        if (!hit.front && !place_.surfaces.all()[surface].double_sided)
            return Met::nothing;
        const std::uint32_t j = lumel_near(hit);
        if (j == kNoLumel)
            return Met::lost;

        const Lumel& lumel = place_.lumels.lumels[j];
        const glm::vec3 position = origin + hit.distance * direction;
        std::uint32_t cell = cells_.cell(j, position);
        const bool can_go_on = reflections < kMostReflections;
        const float near = hit.distance / std::max(size, lumel.size);
        bool goes_on = can_go_on && near < kTooNear;
        if (!goes_on && (parts_.is_cut(j) || near < kMayBeHidden) &&
            !seen_cell(j, position, seed, cell)) {
            if (!can_go_on)
                return Met::nothing;
            goes_on = true;
        }
        if (!goes_on) {
            ray.reflected += ray.weight * lumel.albedo * direct_.at(j, cell);
            ray.part = parts_.part(j, cell);
            return Met::part;
        }
        ray.weight *= lumel.albedo;
        if (ray.weight == glm::vec3(0.0f))
            return Met::nothing;
        const glm::vec3 normal = hit.front ? hit.normal : -hit.normal;
        origin = origin + direction * std::max(0.0f, hit.distance - lift_) + lift_ * normal;
        ray.reflected += ray.weight * direct_.light_at({origin, normal, normal, cell}, lumel.size,
                                                       samples.bits(pair));
        direction = frame_about(normal) * by_cosine(samples.random(pair + 1));
        size = lumel.size;
    }
}

void LinkTracer::trace_block(std::size_t b, const std::vector<std::uint16_t>& rays,
                             std::uint32_t stream, Gathered& into) const
{
    LinkBlock& block = into.rounds.back()[b];
    block.first.push_back(0);
    block.first_weak.push_back(0);
    std::vector<std::uint32_t> targets[kMostParts];
    std::vector<WeakLink> weak[kMostParts];
    const std::size_t end = std::min((b + 1) * kLinkBlock, order_.size());
    for (std::size_t o = b * kLinkBlock; o < end; ++o) {
        const std::uint32_t i = order_[o];
        const std::uint32_t first = parts_.first(i), parts = parts_.end(i) - first;
        const bool buried = (place_.lumels.lumels[i].flags & kLumelBuried) != 0;
        const std::uint32_t own = PathSamples::hash(PathSamples::hash(seed_, stream), i);
        for (std::uint32_t k = 0; k < (buried ? 0u : rays[i]); ++k) {
            const PathSamples samples(own, k);
            const RayStart start = starts_.start(i, samples.stratified(kStartPair));
            const std::uint32_t p = parts_.part(i, start.cell) - first;
            const glm::vec3 direction =
                frame_about(start.normal) * by_cosine(samples.stratified(kDirectionPair));
            Followed ray;
            const Met met = start.cosine(direction) > 0.0f
                                ? follow(i, start, direction, samples, ray)
                                : Met::nothing;
            into.nearest[first + p] = std::min(into.nearest[first + p], ray.nearest);
            block.loses = block.loses || met != Met::part;
            if (met == Met::lost)
                continue;
            ++into.rays[first + p];
            into.reflected[first + p] += ray.reflected;
            into.sky[first + p] += ray.sky;
            if (met == Met::part && ray.weight == glm::vec3(1.0f))
                targets[p].push_back(ray.part);
            else if (met == Met::part)
                weak[p].push_back({ray.part, glm::packF3x9_E1x5(ray.weight)});
        }
        for (std::uint32_t p = 0; p < parts; ++p) {
            block.target.insert(block.target.end(), targets[p].begin(), targets[p].end());
            block.weak.insert(block.weak.end(), weak[p].begin(), weak[p].end());
            block.first.push_back(std::uint32_t(block.target.size()));
            block.first_weak.push_back(std::uint32_t(block.weak.size()));
            targets[p].clear();
            weak[p].clear();
        }
    }
    block.target.shrink_to_fit();
    block.weak.shrink_to_fit();
}

void LinkTracer::trace(std::size_t first, std::size_t last, const std::vector<std::uint16_t>& rays,
                       std::uint32_t stream, Gathered& into) const
{
    parallel_for(last - first, 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t b = first + from; b < first + to; ++b)
            trace_block(b, rays, stream, into);
    });
}

}  // namespace lumel
