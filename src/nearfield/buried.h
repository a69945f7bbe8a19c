#pragma once
// Lumels that lie under or inside other geometry.

#include "atlas/atlas.h"
#include "rays/ray_scene.h"
#include "scene/scene.h"

namespace lumel {

/// Finds how much of each lumel lies under or inside other geometry (Lumel::hidden), and marks
/// those of which less than an eighth is open (kLumelBuried).
///
/// Points all over a lumel cast rays all over their hemisphere. A ray is shut in if it first meets
/// the back of a single-sided surface (it started inside of closed geometry), or anything at all
/// within a hundredth of the lumel's size above it (a surface lying on it). A point is hidden if
/// every ray of it is shut in; one ray that gets away, or meets a front or a double-sided surface
/// farther off, clears it. So the dark inside of a sealed but roomy box is not buried.
void mark_buried(const Scene& scene, const RayScene& rays, Lumels& lumels);

}  // namespace lumel
