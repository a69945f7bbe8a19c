#pragma once
// What two casters of rays have met.

#include <cmath>

#include "rays/cast/ray_caster.h"

namespace lumel::support {

/// Of distances [m], barycentrics and normals.
inline constexpr float kHitRounding = 1e-4f;

inline bool same(const RayHit& one, const RayHit& other)
{
    if (one.distance == RayCaster::kNothing || other.distance == RayCaster::kNothing)
        return one.distance == other.distance && one.tint == other.tint;
    const bool alike = glm::distance(one.barycentric, other.barycentric) < kHitRounding &&
                       glm::distance(one.normal, other.normal) < kHitRounding &&
                       glm::distance(one.tint, other.tint) < kHitRounding;
    return one.instance == other.instance && one.primitive == other.primitive &&
           one.triangle == other.triangle && one.front == other.front && alike &&
           std::abs(one.distance - other.distance) < kHitRounding;
}

}  // namespace lumel::support
