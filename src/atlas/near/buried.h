#pragma once
// Lumels under or inside other geometry.

#include "atlas/packing/atlas.h"
#include "base/ranks/ranks.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"

namespace lumel {

/// Reduces lumels to the part that light can reach, and marks those with less than a tenth left
/// (kLumelBuried). Area under or inside other geometry neither receives nor emits, so that it
/// neither darkens nor leaks; area and pieces are then those of the open part.
///
/// Points of a lumel trace rays over their hemisphere. A ray is blocked if its closest hit is a
/// back (it started inside closed geometry): that of a single-sided surface, or an inner side of a
/// double-sided one (Atlas::inner). It is also blocked by a hit within a hundredth of the lumel's
/// size above it (a surface lying on it). A point is hidden if all its rays are blocked; it is open
/// if one ray escapes, or hits another side farther away. So the dark inside of a sealed box of
/// fronts is not buried. Lumels on inner sides are.
///
/// Where many rays of a lumel hit backs nearby, a point is hidden too if few of its rays hit
/// fronts, nearby, and diffuse reflections from these end at a back: wall and floor behind a
/// skirting board without a back of its own are fronts, but are shut in with it.
///
/// Returns the open share of each lumel's area [N], 0 if buried. chosen [N]: changes only these
/// lumels and returns 1 for the others; empty: all. ranks: that share the work; null: none.
std::vector<float> mark_buried(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                               Lumels& lumels, const std::vector<char>& chosen = {},
                               const ProgressCallback& progress = {}, Ranks* ranks = nullptr);

}  // namespace lumel
