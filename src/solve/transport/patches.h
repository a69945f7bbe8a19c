#pragma once
// Lumels grouped into the patches that shoot.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Section 4.3.

#include <span>
#include <vector>

#include "atlas/packing/atlas.h"
#include "solve/transport/patch_shots.shared.h"

namespace lumel {

/// Elements receive, patches shoot (substructuring).
struct Patches {
    std::vector<Patch> patches;      ///< [P] of block levels, each chart's of a level in a row
    std::vector<PatchChart> charts;  ///< [C] fronts and backs of a chart apart
};

/// Groups the lumels of each chart into blocks of texels. A block that is bent, or holds buried
/// lumels and so may reach through a wall, falls apart into smaller ones.
Patches make_patches(const Lumels& lumels);

/// The same for any grouping: blocks of 4 × 4 texels, or smaller, none of which has lumels of two
/// groups. group: [N].
std::vector<Patch> make_blocks(const Lumels& lumels, std::span<const std::uint32_t> group);

/// Patches of a chart at a level, and points that each of its lumels shoots from. Twins of
/// solve/transport/patches.glsl.
std::uint32_t patches_of(const PatchChart& chart, std::uint32_t level);
std::uint32_t points_per_lumel(std::uint32_t level);
/// The lumels of a chosen patch, as patch_shots.take.comp has them.
Patch patch_of(const Patches& layout, const ChosenPatch& chosen);

}  // namespace lumel
