#pragma once
// Light on the two sides of double-sided charts.

#include <array>
#include <span>
#include <vector>

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// Looks for light on both sides of double-sided charts [charts] by random walks from them. Both
/// are shown if enough walks from each side find a lamp, the sky or an emissive surface, or if
/// enough from one side do, which faces a room, and the other faces a dark room. A side is inside a
/// solid if no walk finds light and most rays from it are shorter than 1 m. Lamps that are off
/// count as on, since they may be switched on later. daylit: the sky counts as light whatever it is
/// in the scene.
std::vector<ChartSides> light_on_sides(const Scene& scene, const RayScene& rays,
                                       std::span<const std::vector<TriangleOf>> charts,
                                       bool daylit = false);

/// Atlas::inner of an atlas, which one out of a file lacks; and the atlas with it.
std::vector<std::array<bool, 2>> find_inner_sides(const Scene& scene, const RayScene& rays,
                                                  const Atlas& atlas);
Atlas with_inner_sides(const Scene& scene, const RayScene& rays, Atlas atlas);

/// Argument of make_atlas for these sides. `rays` must outlive it. daylit: as above.
FindSides sides_by_light(Sides sides, const RayScene& rays, bool daylit = false);

}  // namespace lumel
