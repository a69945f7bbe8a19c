#pragma once
// Texel density of surfaces: set by the file or an option, else by the distance from the content.

#include <string>
#include <vector>

#include "atlas/packing/atlas.h"

namespace lumel {

struct Density {
    double fixed = 0.0;     ///< [texels/m], 0: not set
    double relative = 1.0;  ///< relative to the density of the map, if not fixed

    /// Density [texels/m] in a map of `common` texels per metre.
    double in(double common) const { return fixed > 0.0 ? fixed : relative * common; }
};

/// [instances][primitives] of each surface.
///
/// A density is set by the last rule of `options.densities` whose pattern (shell wildcards * ? [])
/// matches the name of the node, the mesh or the material, else by the file: Instance, then
/// Material::texels_per_metre.
///
/// Otherwise, with `options.coarse_afar`, surfaces are mapped as seen from the border of the
/// content. Content is the bounding box of the cameras and of all triangles up to twice the median
/// area, because viewers are near detail. Half the middle side of the box, L, is the viewing
/// distance: a point at distance d from the box gets min(1, L / d) of the density, so that a
/// distant texel subtends the same angle as one at L. A surface gets the RMS of this over its area:
/// as many texels as its points together, and exactly 1 within L.
std::vector<std::vector<Density>> densities_of(const Scene& scene, const AtlasOptions& options);

/// Patterns of rules that match no name in the scene.
std::vector<std::string> unmatched(const Scene& scene, const std::vector<DensityRule>& rules);

}  // namespace lumel
