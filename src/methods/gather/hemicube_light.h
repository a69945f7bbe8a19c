#pragma once
// Light on hemicubes: delta form factors, and the lumels that texels show.
//
//   [CG85]   Cohen, Greenberg. The Hemi-Cube: A Radiosity Solution for Complex Environments. 1985.

#include <cstdint>
#include <vector>

#include "atlas/packing/atlas.h"

namespace lumel {

/// [texels][2] as from lumels_by_side; texels without lumels show those of the nearest texel with
/// some, by distance in steps to neighbours.
std::vector<std::uint32_t> nearest_lumels_by_side(const Lumels& lumels);

/// [pixels of a hemicube's tile][kManySamples] ΔF, which sum to 1: form factors of the parts of a
/// pixel that its samples represent. Sample s of standard locations lies in the s-th quarter of the
/// rows. That matters near the horizon, where the form factors within the lowest pixels run from 0
/// to twice their mean.
std::vector<float> delta_form_factors(std::uint32_t side, bool standard_samples);

}  // namespace lumel
