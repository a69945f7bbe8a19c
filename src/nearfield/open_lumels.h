#pragma once
// Which lumels see more than surfaces that send light.

#include <vector>

#include "atlas/atlas.h"
#include "rays/ray_scene.h"

namespace lumel {

/// [N] 1 for lumels some of whose rays leave the scene, meet the back of a single-sided surface, or
/// pass glass or what is cut out; else their form factors add up to 1.
std::vector<char> open_lumels(const Scene& scene, const RayScene& rays, const Lumels& lumels);

}  // namespace lumel
