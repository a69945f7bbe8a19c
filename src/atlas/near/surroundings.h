#pragma once
// Ray-traced neighbourhood of lumels: open to the outside, joined to the next texel.

#include <vector>

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

struct Surroundings {
    /// [N] 1 if some rays of the lumel leave the scene, hit the back of a single-sided surface, or
    /// pass glass or cut-outs; otherwise its form factors sum to 1.
    std::vector<char> open;
    /// [N] 1 if the segment to the neighbour on the same side of the chart, in the texel to the
    /// right or below, is free; 0 if there is none.
    std::vector<char> joined_right, joined_below;
};

Surroundings find_surroundings(const Scene& scene, const RayScene& rays, const Lumels& lumels);

}  // namespace lumel
