#pragma once
// Options of illumination along directions.

#include <cstdint>

#include "atlas/lumels/sample_rule.h"
#include "raster/parallel/layers.h"
#include "solve/shooting/iteration_options.h"

namespace lumel {

/// Occlusion test for samples of Layers::stochastic, see directions.gather.comp.
enum class LookupTest : std::uint32_t {
    planes,  ///< by the planes of both
    paper,   ///< by the lumel's own, as [TN11] Figure 5
};

struct DirectionsOptions {
    std::uint32_t seed = 1;
    int batch = 16;  ///< K, directions at a time
    SampleRule rule = SampleRule::area;
    IterationOptions iteration;
    Layers layers = Layers::list;  ///< storage in illumination maps
    int lookups = 3;               ///< with Layers::stochastic: 1, 3 or 5 pixels wide and high
    LookupTest lookup_test = LookupTest::planes;
    /// With Layers::stochastic: slabs that a direction is cut into; 0: as many as the overdraw
    /// requires, see IlluminationMaps.
    std::uint32_t slabs = 0;
    int map_side = 0;  ///< side of an illumination map [pixels], 0: from the size of lumels
    bool sky = true;   ///< with Scheme::paper: gathers the world's sky
};

}  // namespace lumel
