// Links that can change when an object moves:
//
// - those that start on it,
// - those that ended on it; rays absorbed on it have an end of their own,
// - those that hit it at its new position. Only rays in the direction cells that cover it are
//   regenerated, and tested against the object alone.
//
// Links that only passed its old position keep their ends.

#include "links/live/lumel_links.h"

#include <limits>
#include <numbers>

#include "base/core/error.h"
#include "base/core/frame.h"
#include "base/core/parallel.h"
#include "base/core/sphere.h"
#include "links/live/direction_cells.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Lumels per task: for all their links, and for those that a move can change.
constexpr std::size_t kTracedPerTask = 256, kRetracedPerTask = 64;
/// Random numbers of a ray: positions within its direction cell and origin cell.
constexpr std::uint32_t kAcross = 1, kStart = 2, kStartAcross = 3;

float to_unit(std::uint32_t key, std::uint32_t what)
{
    return PathSamples::to_unit(PathSamples::hash(key, what));
}

}  // namespace

/// The rays of a lumel, in one common frame.
class LumelLinks::Rays {
public:
    Rays(const LumelLinks& links, std::size_t lumel)
        : links_(links),
          lumel_(lumel),
          own_(links.key_of(lumel)),
          frame_(frame_about(links.place_.world[lumel].normal))
    {
    }

    const glm::mat3& frame() const { return frame_; }

    glm::vec3 direction(std::uint32_t k) const
    {
        const std::uint32_t key = PathSamples::hash(own_, k), side = links_.side_;
        return frame_ * by_cosine((glm::vec2(k % side, k / side) +
                                   glm::vec2(PathSamples::to_unit(key), to_unit(key, kAcross))) /
                                  float(side));
    }
    /// Origins lie in the cells of a grid over the lumel, a different one for each ray. Rays of
    /// similar elevation or azimuth have distant cells.
    RayOrigin start(std::uint32_t k) const
    {
        const std::uint32_t key = PathSamples::hash(own_, k), side = links_.side_;
        const std::uint32_t u = k % side, v = k / side;
        const glm::vec2 cell((u + 3 * v + own_) % side, (3 * u + 2 * v + (own_ >> 16)) % side);
        return links_.place_.starts.start(
            lumel_,
            (cell + glm::vec2(to_unit(key, kStart), to_unit(key, kStartAcross))) / float(side));
    }
    RaySpan ray(const RayOrigin& start, const glm::vec3& direction, std::uint32_t k) const
    {
        return ray_out(start.position, direction, PathSamples::hash(own_, k));
    }

private:
    const LumelLinks& links_;
    std::size_t lumel_;
    std::uint32_t own_;
    glm::mat3 frame_;
};

std::uint32_t side_of_rays(std::uint32_t rays)
{
    for (const std::uint32_t side : {2u, 4u, 8u, 16u})
        if (rays == side * side)
            return side;
    throw Error(ErrorKind::input, std::to_string(rays) + " rays",
                "are not a grid: use 4, 16, 64 or 256");
}

LumelLinks::LumelLinks(const LinkContext& place, std::uint32_t side, std::uint32_t seed)
    : place_(place),
      near_(place.scene.scene, place.scene.atlas, place.scene.lumels),
      side_(side),
      seed_(seed),
      lumels_(std::uint32_t(place.lumels().size())),
      links_(std::size_t(lumels_) * rays()),
      on_thing_(lumels_ + 2, DynamicRayScene::kStatic),
      sky_light_(lumels_),
      white_sky_light_(lumels_)
{
    for (std::uint32_t i = 0; i < lumels_; ++i)
        on_thing_[i] = place_.object_of(i);
    for (std::uint32_t i = 0; i < place_.scene.scene.instances.size(); ++i)
        on_thing_.push_back(place_.rays.object_of(i));
    parallel_for(lumels_, kTracedPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            trace(i);
    });
}

/// Visits a lumel's rays that can hit something in a box.
template <class Visit>
void LumelLinks::for_rays_towards(const Rays& rays_of, std::size_t i, const Box& box,
                                  const Visit& visit) const
{
    const float reach = place_.reach(i);
    const glm::vec3& centre = place_.world[i].centre;
    const glm::mat3 into = glm::transpose(rays_of.frame());
    const glm::vec3 half = 0.5f * (box.high - box.low) + reach;
    const glm::mat3 sides(half.x * into[0], half.y * into[1], half.z * into[2]);
    const DirectionCells cells = cells_towards(into * (box.centre() - centre), sides, side_);
    cells.for_each(side_, [&](std::uint32_t k) {
        const glm::vec3 direction = rays_of.direction(k);
        if (box.may_meet(centre, direction, std::numeric_limits<float>::max(), reach))
            visit(k, direction);
    });
}

void LumelLinks::find_sky()
{
    parallel_for(lumels_, kTracedPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (!place_.is_buried(i))
                find_sky(Rays(*this, i), i);
    });
}

glm::vec3 LumelLinks::direction(std::size_t lumel, std::uint32_t ray) const
{
    return Rays(*this, lumel).direction(ray);
}

/// End of ray k of a lumel.
std::uint32_t LumelLinks::end_of(const Rays& rays, std::uint32_t k) const
{
    const RayOrigin start = rays.start(k);
    const RaySpan ray = rays.ray(start, rays.direction(k), k);
    if (!(start.cosine(ray.direction) > 0.0f))
        return lost();
    RayHit hit;
    return place_.rays.closest(ray, hit) ? end_at(hit) : sky();
}

/// Its end if it hits this object. The hit is the closest unless something occludes it, which costs
/// less to test than a closest hit.
std::optional<std::uint32_t> LumelLinks::end_by(const Rays& rays, std::uint32_t k,
                                                const glm::vec3& direction, std::uint32_t thing,
                                                Misses misses) const
{
    const RayOrigin start = rays.start(k);
    RaySpan ray = rays.ray(start, direction, k);
    RayHit hit;
    const bool is_above = start.cosine(ray.direction) > 0.0f;
    if (is_above && place_.rays.closest_on(thing, ray, hit)) {
        ray.far = hit.distance;
        return place_.rays.is_clear_but_for(thing, ray) ? end_at(hit) : end_of(rays, k);
    }
    if (misses == Misses::stay)
        return std::nullopt;
    if (!is_above)
        return lost();
    return place_.rays.closest_but_for(thing, ray, hit) ? end_at(hit) : sky();
}

std::uint32_t LumelLinks::end_at(const RayHit& hit) const
{
    const std::size_t surface = place_.scene.surfaces.index(hit.instance, hit.primitive);
    const bool reflects = hit.front || place_.scene.surfaces.all()[surface].double_sided;
    const std::uint32_t lumel = reflects ? near_.lumel(hit) : kNoLumel;
    if (lumel != kNoLumel)
        return lumel;
    return lost_on(hit.instance);
}

void LumelLinks::trace(std::size_t i)
{
    std::uint32_t* links = &links_[i * rays()];
    if (place_.is_buried(i)) {
        std::fill(links, links + rays(), lost());
        return;
    }
    const Rays rays_of(*this, i);
    for (std::uint32_t k = 0; k < rays(); ++k)
        links[k] = end_of(rays_of, k);
    find_sky(rays_of, i);
}

void LumelLinks::find_sky(const Rays& rays_of, std::size_t i)
{
    if (place_.scene.scene.sky.empty())
        return;
    glm::vec3 sums[2] = {glm::vec3(0.0f), glm::vec3(0.0f)};
    const std::span<const std::uint32_t> links = of(i);
    for (std::uint32_t k = 0; k < rays(); ++k)
        if (links[k] == sky())
            sums[half_of(k)] += place_.sources.dim_sky(rays_of.direction(k));
    const float share = std::numbers::pi_v<float> / float(rays());
    sky_light_[i] = share * (sums[0] + sums[1]);
    white_sky_light_[i] = share * sums[0];
}

/// Seed of a lumel's random numbers. The lumel's index can change when objects are added or
/// removed.
std::uint32_t LumelLinks::key_of(std::size_t i) const
{
    const Lumel& lumel = place_.lumels()[i];
    const auto width = std::uint32_t(place_.scene.lumels.width);
    return PathSamples::hash(
        PathSamples::hash(PathSamples::hash(seed_, lumel.texel % width), lumel.texel / width),
        lumel.flags & kLumelBack ? 1u : 0u);
}

Retraced LumelLinks::follow(std::uint32_t thing, std::span<const std::uint32_t> lumels)
{
    const Box box = place_.rays.box(thing);
    std::vector<Retraced> blocks((lumels.size() + kRetracedPerTask - 1) / kRetracedPerTask);
    parallel_for(blocks.size(), 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t b = from; b < to; ++b)
            for (const std::uint32_t i :
                 lumels.subspan(b * kRetracedPerTask)
                     .first(std::min(kRetracedPerTask, lumels.size() - b * kRetracedPerTask)))
                blocks[b] += follow(i, thing, box);
    });
    Retraced sum;
    for (const Retraced& block : blocks)
        sum += block;
    return sum;
}

Retraced LumelLinks::follow(std::size_t i, std::uint32_t thing, const Box& box)
{
    Retraced count;
    if (place_.is_buried(i))
        return count;
    if (on_thing_[i] == thing) {
        trace(i);
        count.started = rays();
        return count;
    }
    std::uint32_t* links = &links_[i * rays()];
    const Rays rays_of(*this, i);
    bool sky_changed = false;
    const auto set = [&](std::uint32_t k, std::uint32_t end) {
        sky_changed |= links[k] != end && (links[k] == sky() || end == sky());
        links[k] = end;
    };
    for (std::uint32_t k = 0; k < rays(); ++k)
        if (on_thing_[links[k]] == thing) {
            set(k, *end_by(rays_of, k, rays_of.direction(k), thing, Misses::go_on));
            ++count.ended;
        }
    for_rays_towards(rays_of, i, box, [&](std::uint32_t k, const glm::vec3& direction) {
        if (on_thing_[links[k]] == thing)
            return;
        if (const std::optional<std::uint32_t> end =
                end_by(rays_of, k, direction, thing, Misses::stay)) {
            set(k, *end);
            ++count.crossed;
        }
    });
    if (sky_changed)
        find_sky(rays_of, i);
    return count;
}

}  // namespace lumel
