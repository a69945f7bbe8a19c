#pragma once
// What a scene in which things move gives to those that trace its light.

#include "links/sources.h"
#include "live/thing_rays.h"

namespace lumel {

struct LivePlace {
    const Scene& scene;
    const Lumels& lumels;
    const ThingRays& rays;
    const Surfaces& surfaces;
    const WorldLumels& world;
    const RayStarts& starts;
    const LightSources& sources;
    float lift;  ///< how far off surfaces rays start [m]

    /// The thing that a lumel is on, or ThingRays::kStays.
    std::uint32_t thing_of(std::size_t lumel) const
    {
        return rays.thing_of(lumels.lumels[lumel].instance);
    }
    /// No point of a lumel, nor where its rays start, is farther from its centre [m].
    float reach(std::size_t lumel) const
    {
        return kReach * lumels.lumels[lumel].size + kLifts * lift;
    }

private:
    /// A lumel is √2 of its sizes wide at most. Starts are lifted twice.
    static constexpr float kReach = 1.5f, kLifts = 2.0f;
};

}  // namespace lumel
