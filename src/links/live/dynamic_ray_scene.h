#pragma once
// Rays through a scene in which things move.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/core/box.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// What moves has a tree of its own, what stays has another; the nearest hit counts. So the tree of
/// the scene is never built again, and what one thing alone does to a ray can be asked.
class DynamicRayScene {
public:
    /// things: the instances of each. The scene must outlive it, unmoved.
    /// Throws Error{device} if Embree cannot build a tree.
    DynamicRayScene(const Scene& scene, std::vector<std::vector<std::uint32_t>> things);

    /// Takes a thing's tree from where its instances are now.
    void place(std::size_t thing);

    /// The first hit along a ray, or false.
    bool closest(const RaySpan& ray, RayHit& hit) const
    {
        return closest_but_for(kStatic, ray, hit);
    }
    /// The same as if this thing were not there.
    bool closest_but_for(std::size_t thing, const RaySpan& ray, RayHit& hit) const;
    /// Does nothing lie along a ray?
    bool is_clear(const RaySpan& ray) const;
    /// The first hit of a thing alone, or false.
    bool closest_on(std::size_t thing, const RaySpan& ray, RayHit& hit) const
    {
        return may_meet(thing, ray) && trees_[thing].closest(ray, hit);
    }
    /// Does nothing but perhaps this thing lie along a ray?
    bool is_clear_but_for(std::size_t thing, const RaySpan& ray) const;

    std::size_t things() const { return trees_.size(); }
    const std::vector<std::uint32_t>& instances(std::size_t thing) const { return things_[thing]; }
    const Box& box(std::size_t thing) const { return boxes_[thing]; }
    /// How far off a surface rays should start, wherever things are [m].
    float ray_offset() const { return ray_offset_; }
    const RayScene& still() const { return still_; }

    static constexpr std::uint32_t kStatic = ~0u;
    /// The thing that an instance is part of, or kStatic.
    std::uint32_t object_of(std::uint32_t instance) const { return thing_of_[instance]; }

private:
    bool may_meet(std::size_t thing, const RaySpan& ray) const;

    const Scene* scene_;
    std::vector<std::vector<std::uint32_t>> things_;
    std::vector<std::uint32_t> thing_of_;  ///< [instances]
    RayScene still_;
    float ray_offset_;             ///< [m]
    std::vector<RayScene> trees_;  ///< [things]
    std::vector<Box> boxes_;       ///< [things] around them
};

}  // namespace lumel
