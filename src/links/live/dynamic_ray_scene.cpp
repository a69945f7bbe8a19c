#include "links/live/dynamic_ray_scene.h"

#include <algorithm>
#include <stdexcept>

#include "base/core/error.h"

namespace lumel {
namespace {

std::vector<std::uint32_t> things_by_instance(const Scene& scene,
                                              const std::vector<std::vector<std::uint32_t>>& things)
{
    std::vector<std::uint32_t> result(scene.instances.size(), DynamicRayScene::kStatic);
    for (std::uint32_t t = 0; t < things.size(); ++t)
        for (const std::uint32_t instance : things[t])
            result[instance] = t;
    return result;
}

void refuse_coloured_glass(const Scene& scene)
{
    for (const Material& material : scene.materials)
        if (is_coloured_glass(material))
            throw Error(ErrorKind::input, scene.path,
                        "has coloured glass (material \"" + material.name +
                            "\"), which links do not support; make it white, or opaque");
}

}  // namespace

DynamicRayScene::DynamicRayScene(const SolveScene& scene,
                                 std::vector<std::vector<std::uint32_t>> things)
    : scene_(&scene.scene),
      things_(std::move(things)),
      thing_of_(things_by_instance(scene.scene, things_)),
      still_(&scene.rays),
      ray_offset_(still_->ray_offset())
{
    refuse_coloured_glass(scene.scene);
    for (std::uint32_t i = 0; i < thing_of_.size(); ++i)
        if ((thing_of_[i] != kStatic) !=
            std::binary_search(scene.movers.begin(), scene.movers.end(), i))
            throw std::logic_error("the things of a live scene are not the movers of its rays");
    for (const std::vector<std::uint32_t>& instances : things_) {
        const RayScene& tree = trees_.emplace_back(scene.scene, instances);
        boxes_.push_back({tree.low(), tree.high()});
    }
}

void DynamicRayScene::place(std::size_t thing)
{
    trees_[thing] = RayScene(*scene_, things_[thing]);
    boxes_[thing] = {trees_[thing].low(), trees_[thing].high()};
}

bool DynamicRayScene::closest_but_for(std::size_t thing, const RaySpan& ray, RayHit& hit) const
{
    RaySpan rest = ray;
    bool any = still_->closest(rest, hit);
    for (std::size_t t = 0; t < trees_.size(); ++t) {
        if (any)
            rest.far = hit.distance;
        if (t != thing && may_meet(t, rest))
            any = trees_[t].closest(rest, hit) || any;
    }
    return any;
}

bool DynamicRayScene::is_clear(const RaySpan& ray) const
{
    return is_clear_but_for(kStatic, ray);
}

bool DynamicRayScene::is_clear_but_for(std::size_t thing, const RaySpan& ray) const
{
    if (still_->transmittance(ray) == glm::vec3(0.0f))
        return false;
    for (std::size_t t = 0; t < trees_.size(); ++t)
        if (t != thing && may_meet(t, ray) && trees_[t].transmittance(ray) == glm::vec3(0.0f))
            return false;
    return true;
}

/// Testing a box costs much less than a query of a BVH.
bool DynamicRayScene::may_meet(std::size_t thing, const RaySpan& ray) const
{
    return boxes_[thing].may_meet(ray.origin, ray.direction, ray.far, ray_offset_);
}

}  // namespace lumel
