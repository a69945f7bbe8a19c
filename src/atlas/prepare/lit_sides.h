#pragma once
// Which double-sided charts have light on both sides.

#include <span>
#include <vector>

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// [charts] 1 for double-sided charts both of whose sides light may reach. Light reaches a side if
/// enough of some random walks from it find a lamp, the sky or what glows. From the inside of a
/// closed solid none does.
std::vector<char> lit_on_both_sides(const Scene& scene, const RayScene& rays,
                                    std::span<const std::vector<TriangleOf>> charts);

/// What make_atlas asks for Sides::automatic and Sides::both; empty for others. `rays` must outlive
/// it.
ShowsBoth shows_both(Sides sides, const RayScene& rays);

}  // namespace lumel
