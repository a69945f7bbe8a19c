#pragma once
// From solved lumels to a map that samples well.

#include <span>

#include "atlas/atlas.h"
#include "core/image.h"

namespace lumel {

/// Writes one value per lumel into the atlas: RGB = value, A = coverage (0 where no surface is).
/// A double-sided surface shows, chart by chart, the side whose mean value is the brighter one.
/// values [N]: per lumel, e.g. irradiance [lx].
Image to_map(const Lumels& lumels, std::span<const glm::vec3> values);

/// Gives buried lumels the light of their nearest lit neighbours in the same chart, so that
/// filtering never darkens or leaks; a chart that is buried as a whole stays black.
void fill_buried(Image& map, const Lumels& lumels);

/// Makes both sides of chart borders that share an edge in the world sample alike.
void match_seams(Image& map, const Scene& scene, const Atlas& atlas, const Lumels& lumels);

/// Fills everything uncovered from its nearest covered texels, so that bilinear and mipmapped
/// sampling never sees black. Alpha stays as it is.
void dilate(Image& map);

}  // namespace lumel
