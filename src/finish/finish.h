#pragma once
// From solved lumels to a map that samples well. In order: to_map, fill_buried, dilate,
// match_seams; finish_map does all four.

#include <span>

#include "atlas/atlas.h"
#include "core/image.h"

namespace lumel {

/// The whole room in one call: a map of `values` without black gutters, buried texels or seams.
Image finish_map(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                 std::span<const glm::vec3> values);

/// Writes one value per lumel into the atlas: RGB = value, A = coverage (0 where no surface is,
/// at least 1/255 where one is, so that no covered texel loses its mark in 8 or 16 bits).
/// A double-sided surface shows, chart by chart, the side whose mean value is the brighter one;
/// the mean is by area over what is not buried, and equal sides show the front.
/// values [N]: per lumel, e.g. irradiance [lx].
Image to_map(const Lumels& lumels, std::span<const glm::vec3> values);

/// Gives buried lumels the light of their nearest open neighbours in the same chart, so that
/// filtering never darkens or leaks; a chart that is buried as a whole stays as it is. Where only
/// one side of a double-sided surface is buried, its texel counts as buried if it is black.
void fill_buried(Image& map, const Lumels& lumels);

/// Fills everything uncovered from its nearest covered texels, so that bilinear and mipmapped
/// sampling never sees black. Alpha and covered texels stay as they are.
void dilate(Image& map);

/// Makes both sides of chart borders that share an edge in the world sample alike, within one
/// instance and between neighbours, wherever the surface goes on smoothly. Creases keep their
/// contrast, and so do borders where the light itself jumps (a wall may stand there).
/// `map`: dilated; its gutters are changed most, the outermost covered texels a little.
void match_seams(Image& map, const Scene& scene, const Atlas& atlas, const Lumels& lumels);

}  // namespace lumel
