#pragma once
// Context for tracing light in a scene with movable objects.

#include "lights/sources.h"
#include "links/live/dynamic_ray_scene.h"

namespace lumel {

struct LinkContext {
    const Scene& scene;
    const Lumels& lumels;
    const DynamicRayScene& rays;
    const Surfaces& surfaces;
    const WorldLumels& world;
    const RayOrigins& starts;
    const LightSources& sources;
    float ray_offset;  ///< distance of ray origins from surfaces [m]

    /// The object that a lumel is on, or DynamicRayScene::kStatic.
    std::uint32_t object_of(std::size_t lumel) const
    {
        return rays.object_of(lumels.lumels[lumel].instance);
    }
    /// Bounding radius of a lumel and its ray origins around its centre [m].
    float reach(std::size_t lumel) const
    {
        return kReach * lumels.lumels[lumel].size + kLifts * ray_offset;
    }

private:
    /// Factors: a lumel is at most √2 sizes wide; ray origins are offset twice.
    static constexpr float kReach = 1.5f, kLifts = 2.0f;
};

}  // namespace lumel
