#include "live/thing_rays.h"

#include <algorithm>
#include <cmath>

namespace lumel {
namespace {

/// Directions have no smaller parts, so that their inverses are finite.
constexpr float kLeastPart = 1e-20f;

std::vector<std::uint32_t> things_by_instance(const Scene& scene,
                                              const std::vector<std::vector<std::uint32_t>>& things)
{
    std::vector<std::uint32_t> result(scene.instances.size(), ThingRays::kStays);
    for (std::uint32_t t = 0; t < things.size(); ++t)
        for (const std::uint32_t instance : things[t])
            result[instance] = t;
    return result;
}

std::vector<std::uint32_t> those_that_stay(const std::vector<std::uint32_t>& thing_of)
{
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < thing_of.size(); ++i)
        if (thing_of[i] == ThingRays::kStays)
            result.push_back(i);
    return result;
}

}  // namespace

bool Box::may_meet(const glm::vec3& origin, const glm::vec3& direction, float far,
                   float margin) const
{
    float enter = 0.0f, leave = far;
    for (int c = 0; c < 3; ++c) {
        const float part = std::abs(direction[c]) > kLeastPart ? direction[c] : kLeastPart;
        const float a = (low[c] - margin - origin[c]) / part;
        const float b = (high[c] + margin - origin[c]) / part;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

ThingRays::ThingRays(const Scene& scene, std::vector<std::vector<std::uint32_t>> things)
    : scene_(&scene),
      things_(std::move(things)),
      thing_of_(things_by_instance(scene, things_)),
      still_(scene, those_that_stay(thing_of_))
{
    for (const std::vector<std::uint32_t>& instances : things_)
        trees_.emplace_back(scene, instances);
}

void ThingRays::place(std::size_t thing)
{
    trees_[thing] = RayScene(*scene_, things_[thing]);
}

bool ThingRays::closest(const RaySpan& ray, RayHit& hit) const
{
    RaySpan rest = ray;
    bool any = still_.closest(rest, hit);
    for (const RayScene& tree : trees_) {
        if (any)
            rest.far = hit.distance;
        any = tree.closest(rest, hit) || any;
    }
    return any;
}

bool ThingRays::is_clear(const RaySpan& ray) const
{
    const glm::vec3 nothing(0.0f);
    return still_.passing(ray) != nothing &&
           std::all_of(trees_.begin(), trees_.end(),
                       [&](const RayScene& tree) { return tree.passing(ray) != nothing; });
}

bool ThingRays::meets(std::size_t thing, const RaySpan& ray) const
{
    return trees_[thing].passing(ray) == glm::vec3(0.0f);
}

}  // namespace lumel
