#pragma once
// Finds double-sided charts that are lit on both sides.

#include <span>
#include <vector>

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// [charts] 1 for double-sided charts whose two sides light may reach. A side is lit if enough
/// random walks from it find a lamp, the sky or an emissive surface. Inside a closed solid none do.
/// daylit: the sky counts as light whatever it is in the scene.
std::vector<char> lit_on_both_sides(const Scene& scene, const RayScene& rays,
                                    std::span<const std::vector<TriangleOf>> charts,
                                    bool daylit = false);

/// Argument of make_atlas for Sides::automatic and Sides::both; empty for others. `rays` must
/// outlive it. daylit: as above.
ShowsBoth shows_both(Sides sides, const RayScene& rays, bool daylit = false);

}  // namespace lumel
