#pragma once
// Context for tracing light in a scene with movable objects.

#include "lights/sources.h"
#include "links/live/dynamic_ray_scene.h"

namespace lumel {

struct LinkContext {
    const SolveScene& scene;
    const DynamicRayScene& rays;
    const WorldLumels& world;
    const RayOrigins& starts;
    const LightSources& sources;

    const std::vector<Lumel>& lumels() const { return scene.lumels.lumels; }
    bool is_buried(std::size_t lumel) const { return (lumels()[lumel].flags & kLumelBuried) != 0; }

    /// The object that a lumel is on, or DynamicRayScene::kStatic.
    std::uint32_t object_of(std::size_t lumel) const
    {
        return rays.object_of(lumels()[lumel].instance);
    }
    /// Bounding radius of a lumel and its ray origins around its centre [m].
    float reach(std::size_t lumel) const
    {
        return kReach * lumels()[lumel].size + kLifts * rays.ray_offset();
    }

private:
    /// Factors: a lumel is at most √2 sizes wide; ray origins are offset twice.
    static constexpr float kReach = 1.5f, kLifts = 2.0f;
};

}  // namespace lumel
