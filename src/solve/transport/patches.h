#pragma once
// Groups lumels into patches that shoot.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013. Section 4.3.

#include <span>
#include <vector>

#include "atlas/packing/atlas.h"
#include "solve/transport/patch_shots.shared.h"

namespace lumel {

/// Patches that shoot; elements (lumels) receive. Substructuring.
struct Patches {
    std::vector<Patch> patches;      ///< [P] of block levels; contiguous per chart and level
    std::vector<PatchChart> charts;  ///< [C] fronts and backs of a chart are separate
};

/// Groups the lumels of each chart into blocks of texels. A block that is bent, or contains buried
/// lumels and could cross a wall, is split.
Patches make_patches(const Lumels& lumels);

/// Blocks of 4 × 4 texels, or smaller, without lumels of two groups. group: [N].
std::vector<Patch> make_blocks(const Lumels& lumels, std::span<const std::uint32_t> group);

/// Number of a chart's patches at a level, and of points that each lumel shoots from. As in
/// solve/transport/patches.glsl.
std::uint32_t patches_of(const PatchChart& chart, std::uint32_t level);
std::uint32_t points_per_lumel(std::uint32_t level);
/// The lumels of a chosen patch, as in patch_shots.take.comp.
Patch patch_of(const Patches& layout, const ChosenPatch& chosen);

}  // namespace lumel
