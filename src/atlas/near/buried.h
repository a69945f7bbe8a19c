#pragma once
// Lumels that lie under or inside other geometry.

#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"

namespace lumel {

/// Reduces lumels to the part that light can reach, and marks those of which less than a tenth is
/// left (kLumelBuried). Area under or inside other geometry neither receives nor emits, so
/// that it darkens nothing and leaks nothing; area and pieces are then those of the open
/// part.
///
/// Points of a lumel cast rays all over their hemisphere. A ray is shut in if it first meets the
/// back of a single-sided surface (it started inside of closed geometry), or anything at all within
/// a hundredth of the lumel's size above it (a surface lying on it). A point is hidden if every ray
/// of it is shut in; one ray that gets away, or meets a front or a double-sided surface farther
/// off, clears it. So the dark inside of a sealed but roomy box is not buried.
///
/// Returns the open share of each lumel's area [N], 0 of buried ones. chosen [N]: changes these
/// alone and leaves the others as they are, with a share of 1; empty: all.
std::vector<float> mark_buried(const Scene& scene, const RayScene& rays, Lumels& lumels,
                               const std::vector<char>& chosen = {},
                               const ProgressCallback& progress = {});

}  // namespace lumel
