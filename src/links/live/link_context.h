#pragma once
// What a scene in which things move gives to those that trace its light.

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
    float ray_offset;  ///< how far off surfaces rays start [m]

    /// The thing that a lumel is on, or DynamicRayScene::kStatic.
    std::uint32_t object_of(std::size_t lumel) const
    {
        return rays.object_of(lumels.lumels[lumel].instance);
    }
    /// No point of a lumel, nor where its rays start, is farther from its centre [m].
    float reach(std::size_t lumel) const
    {
        return kReach * lumels.lumels[lumel].size + kLifts * ray_offset;
    }

private:
    /// A lumel is √2 of its sizes wide at most. Starts are lifted twice.
    static constexpr float kReach = 1.5f, kLifts = 2.0f;
};

}  // namespace lumel
