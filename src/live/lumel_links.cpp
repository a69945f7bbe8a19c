// Which links can change when a thing moves:
//
// - those that start on it,
// - those that ended on it, of which those that were lost on it have an end of their own,
// - those that meet it in its new place. Only the rays of the cells of directions that lead to it
// are
//   made again, and ask the thing alone.
//
// What merely passed its old place meets what it met before.

#include "live/lumel_links.h"

#include <array>
#include <limits>
#include <numbers>

#include "core/frame.h"
#include "core/parallel.h"
#include "core/sphere.h"
#include "live/direction_cells.h"
#include "paths/samples.h"

namespace lumel {
namespace {

/// Lumels worth a task: all of their links, and those that a move may change.
constexpr std::size_t kGrain = 256, kFollowed = 64;
/// Random numbers of a ray: places within its cells of directions and of starts.
constexpr std::uint32_t kAcross = 1, kStart = 2, kStartAcross = 3;

float to_unit(std::uint32_t key, std::uint32_t what)
{
    return PathSamples::to_unit(PathSamples::hash(key, what));
}

}  // namespace

/// The rays of a lumel. All have one frame.
class LumelLinks::Rays {
public:
    Rays(const LumelLinks& links, std::size_t lumel)
        : links_(links),
          lumel_(lumel),
          own_(PathSamples::hash(links.seed_, std::uint32_t(lumel))),
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
    /// Starts lie in the cells of a grid over the lumel, another for each ray. The cells of rays
    /// that go up alike, or around alike, are apart.
    RayStart start(std::uint32_t k) const
    {
        const std::uint32_t key = PathSamples::hash(own_, k), side = links_.side_;
        const std::uint32_t u = k % side, v = k / side;
        const glm::vec2 cell((u + 3 * v + own_) % side, (3 * u + 2 * v + (own_ >> 16)) % side);
        return links_.place_.starts.start(
            lumel_,
            (cell + glm::vec2(to_unit(key, kStart), to_unit(key, kStartAcross))) / float(side));
    }
    RaySpan ray(const RayStart& start, std::uint32_t k) const
    {
        return ray_out(start.position, direction(k), PathSamples::hash(own_, k));
    }

private:
    const LumelLinks& links_;
    std::size_t lumel_;
    std::uint32_t own_;
    glm::mat3 frame_;
};

LumelLinks::LumelLinks(const LivePlace& place, const Atlas& atlas, std::uint32_t side,
                       std::uint32_t seed)
    : place_(place),
      near_(place.scene, atlas, place.lumels),
      side_(side),
      seed_(seed),
      lumels_(std::uint32_t(place.lumels.lumels.size())),
      links_(std::size_t(lumels_) * rays()),
      on_thing_(lumels_ + 2, ThingRays::kStays),
      sky_light_(lumels_),
      white_sky_light_(lumels_)
{
    for (std::uint32_t i = 0; i < lumels_; ++i)
        on_thing_[i] = place_.thing_of(i);
    for (std::uint32_t t = 0; t < place_.rays.things(); ++t)
        on_thing_.push_back(t);
    parallel_for(lumels_, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            trace(i);
    });
}

glm::vec3 LumelLinks::direction(std::size_t lumel, std::uint32_t ray) const
{
    return Rays(*this, lumel).direction(ray);
}

/// Where ray k of a lumel ends.
std::uint32_t LumelLinks::end_of(const Rays& rays, std::uint32_t k) const
{
    const RayStart start = rays.start(k);
    const RaySpan ray = rays.ray(start, k);
    if (!(start.cosine(ray.direction) > 0.0f))
        return lost();
    RayHit hit;
    return place_.rays.closest(ray, hit) ? end_at(hit) : sky();
}

std::uint32_t LumelLinks::end_at(const RayHit& hit) const
{
    const std::size_t surface = place_.surfaces.index(hit.instance, hit.primitive);
    const bool reflects = hit.front || place_.surfaces.all()[surface].double_sided;
    const std::uint32_t lumel = reflects ? near_.lumel(hit) : kNoLumel;
    if (lumel != kNoLumel)
        return lumel;
    const std::uint32_t thing = place_.rays.thing_of(hit.instance);
    return thing == ThingRays::kStays ? lost() : lost_on(thing);
}

void LumelLinks::trace(std::size_t i)
{
    std::uint32_t* links = &links_[i * rays()];
    if (place_.lumels.lumels[i].flags & kLumelBuried) {
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
    if (place_.scene.sky.empty())
        return;
    glm::vec3 sums[2] = {glm::vec3(0.0f), glm::vec3(0.0f)};
    const std::span<const std::uint32_t> links = of(i);
    for (std::uint32_t k = 0; k < rays(); ++k)
        if (links[k] == sky())
            sums[half_of(k)] += place_.sources.rest_of_sky(rays_of.direction(k));
    const float share = std::numbers::pi_v<float> / float(rays());
    sky_light_[i] = share * (sums[0] + sums[1]);
    white_sky_light_[i] = share * sums[0];
}

void LumelLinks::find_sky()
{
    parallel_for(lumels_, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (!(place_.lumels.lumels[i].flags & kLumelBuried))
                find_sky(Rays(*this, i), i);
    });
}

Retraced LumelLinks::follow(std::uint32_t thing, std::size_t first, std::size_t last)
{
    const Box box = place_.rays.box(thing);
    std::vector<Retraced> blocks((last - first + kFollowed - 1) / kFollowed);
    parallel_for(blocks.size(), 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t b = from; b < to; ++b) {
            const std::size_t begin = first + b * kFollowed,
                              end = std::min(begin + kFollowed, last);
            for (std::size_t i = begin; i < end; ++i)
                blocks[b] += follow(i, thing, box);
        }
    });
    Retraced sum;
    for (const Retraced& block : blocks)
        sum += block;
    return sum;
}

Retraced LumelLinks::follow(std::size_t i, std::uint32_t thing, const Box& box)
{
    Retraced count;
    if (place_.lumels.lumels[i].flags & kLumelBuried)
        return count;
    if (on_thing_[i] == thing) {
        trace(i);
        count.started = rays();
        return count;
    }
    std::uint32_t* links = &links_[i * rays()];
    const Rays rays_of(*this, i);
    bool sky_changed = false;
    const auto again = [&](std::uint32_t k) {
        const std::uint32_t before = links[k];
        links[k] = end_of(rays_of, k);
        sky_changed |= links[k] != before && (links[k] == sky() || before == sky());
    };
    for (std::uint32_t k = 0; k < rays(); ++k)
        if (on_thing_[links[k]] == thing) {
            again(k);
            ++count.ended;
        }
    const float reach = place_.reach(i);
    const glm::vec3& centre = place_.world[i].centre;
    const glm::vec3 towards = (box.centre() - centre) * rays_of.frame();  // into the frame
    cells_towards(towards, box.radius() + reach, side_).for_each(side_, [&](std::uint32_t k) {
        if (on_thing_[links[k]] == thing ||
            !box.may_meet(centre, rays_of.direction(k), std::numeric_limits<float>::max(), reach) ||
            !place_.rays.meets(thing, rays_of.ray(rays_of.start(k), k)))
            return;
        again(k);
        ++count.crossed;
    });
    if (sky_changed)
        find_sky(rays_of, i);
    return count;
}

}  // namespace lumel
