#pragma once
// Options of the default method.

#include <cstdint>
#include <vector>

#include "atlas/lumels/sample_rule.h"
#include "lights/lamps.h"

namespace lumel {

/// Ray tracing backend.
enum class Rays {
    automatic,  ///< GPU ray queries if the device has them and is not a CPU; else the host
    host,
    query,   ///< the device's ray queries
    tree,    ///< compute shaders of the device, which walk a BVH
    raster,  ///< GPU rasterisation for rays that leave lumels; the host traces others
};

struct LinksOptions {
    std::uint32_t seed = 1;
    SampleRule rule = SampleRule::area;
    bool filter = true;  ///< averages similar lumels of a chart
    bool guide = true;   ///< rays after the first round follow the light
    Rays rays = Rays::automatic;
    /// All lumels draw their directions from one set, as always with Rays::raster; else every lumel
    /// has its own.
    bool shared_directions = false;
    /// Rays per lumel, in all solutions: traced evenly, in one round, and no more. 0: as many as
    /// the target error requires.
    std::uint32_t even_rays = 0;
    bool per_lamp = false;          ///< keeps the light of lamps apart
    std::vector<LampGroup> groups;  ///< of lamps that are kept as one
    /// No source of the scene counts: the links are those of LinkRadiosity::reflected().
    bool outside_light = false;
};

}  // namespace lumel
