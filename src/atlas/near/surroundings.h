#pragma once
// What lumels have around them, as rays find it.

#include <vector>

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

struct Surroundings {
    /// [N] 1 for lumels some of whose rays leave the scene, meet the back of a single-sided
    /// surface, or pass glass or what is cut out; else their form factors add up to 1.
    std::vector<char> open;
    /// [N] 1 if nothing stands between a lumel and its neighbour on the same side of its chart, in
    /// the texel to the right and in the one below; 0 too if there is none.
    std::vector<char> joined_right, joined_below;
};

Surroundings find_surroundings(const Scene& scene, const RayScene& rays, const Lumels& lumels);

}  // namespace lumel
