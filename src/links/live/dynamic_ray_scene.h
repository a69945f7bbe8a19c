#pragma once
// Ray queries in a scene with movable objects.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "base/core/box.h"

namespace lumel {

/// One BVH for static geometry and one per movable object; queries return the nearest hit of all.
/// Moves never rebuild the scene's BVH, and each object can be queried alone.
class DynamicRayScene {
public:
    /// things: the instances of each object, together the movers of the scene, which must outlive
    /// this. Throws Error{device} if Embree cannot build a BVH, Error{input} for coloured glass,
    /// and std::logic_error for other things.
    DynamicRayScene(const SolveScene& scene, std::vector<std::vector<std::uint32_t>> things);

    /// Rebuilds an object's BVH from the current transforms of its instances.
    void place(std::size_t thing);

    /// Closest hit of a ray; false if none.
    bool closest(const RaySpan& ray, RayHit& hit) const
    {
        return closest_but_for(kStatic, ray, hit);
    }
    /// Closest hit, ignoring object `thing`.
    bool closest_but_for(std::size_t thing, const RaySpan& ray, RayHit& hit) const;
    /// True if the ray is unoccluded.
    bool is_clear(const RaySpan& ray) const;
    /// Closest hit on object `thing` alone; false if none.
    bool closest_on(std::size_t thing, const RaySpan& ray, RayHit& hit) const
    {
        return may_meet(thing, ray) && trees_[thing].closest(ray, hit);
    }
    /// True if the ray is unoccluded, ignoring object `thing`.
    bool is_clear_but_for(std::size_t thing, const RaySpan& ray) const;

    std::size_t things() const { return trees_.size(); }
    const std::vector<std::uint32_t>& instances(std::size_t thing) const { return things_[thing]; }
    const Box& box(std::size_t thing) const { return boxes_[thing]; }
    /// Distance of ray origins from surfaces, for any placement of objects [m].
    float ray_offset() const { return ray_offset_; }
    const RayScene& still() const { return *still_; }

    static constexpr std::uint32_t kStatic = ~0u;
    /// The object that an instance belongs to, or kStatic.
    std::uint32_t object_of(std::uint32_t instance) const { return thing_of_[instance]; }

private:
    bool may_meet(std::size_t thing, const RaySpan& ray) const;

    const Scene* scene_;
    std::vector<std::vector<std::uint32_t>> things_;
    std::vector<std::uint32_t> thing_of_;  ///< [instances]
    const RayScene* still_;
    float ray_offset_;             ///< [m]
    std::vector<RayScene> trees_;  ///< [things]
    std::vector<Box> boxes_;       ///< [things] their bounds
};

}  // namespace lumel
