#pragma once
// How densely each surface is mapped: as its file or an option sets it, else by how near it is to
// where people look.

#include <vector>

#include "atlas/packing/atlas.h"

namespace lumel {

struct Density {
    double fixed = 0.0;     ///< [texels/m], 0: not set
    double relative = 1.0;  ///< of the density of the map, where none is set

    /// [texels/m] in a map of `common` texels per metre.
    double in(double common) const { return fixed > 0.0 ? fixed : relative * common; }
};

/// [instances][primitives] of each surface.
///
/// A density is set by the last rule of `options.densities` whose pattern (as the shell's: * ? [])
/// fits the name of the node, the mesh or the material, else by the file: Instance, then
/// Material::texels_per_metre.
///
/// Otherwise, with `options.coarse_afar`, a surface is mapped as a viewer at the rim of the
/// content sees it. Content is the box of all triangles no larger than twice the median one, for
/// detail is where people look, and of the cameras. Half the middle side of the box, L, is a
/// viewing distance: a point at the distance d from the box gets min(1, L / d) of the density, so
/// that a texel far out subtends the angle that one subtends at L. Of that, a surface gets the root
/// mean square over its area: as many texels as its points together. Exactly 1 within L.
std::vector<std::vector<Density>> densities_of(const Scene& scene, const AtlasOptions& options);

}  // namespace lumel
