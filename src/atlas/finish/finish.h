#pragma once
// From solved lumels to a map that samples well. In order: to_map, fill_buried, dilate,
// match_seams; finish_map does all four.

#include <span>
#include <vector>

#include "atlas/packing/atlas.h"
#include "base/core/image.h"

namespace lumel {

/// The whole room in one call: a map of `values` without black gutters, buried texels or seams.
Image finish_map(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                 std::span<const glm::vec3> values);

/// Maps of both sides of every surface.
struct SideMaps {
    Image front;
    Image back;  ///< as `front` where a surface has one side; empty if all have one
};

/// finish_map for each side, instead of the brighter one.
SideMaps finish_sides(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                      std::span<const glm::vec3> values);

/// Finished maps of one solution.
struct FinishedMaps {
    Image light;
    std::vector<Image> layers;
};

/// The same for `light` and for other quantities that belong to it, such as coefficients of its
/// directions: which side of a surface shows, what counts as black and where seams are matched is
/// decided by `light` for all, and layers may hold values below 0. light [N], layers [L][N].
FinishedMaps finish_maps(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                         std::span<const glm::vec3> light,
                         std::span<const std::vector<glm::vec3>> layers);

/// The lumel that each texel shows, kNoLumel where none: where the sides of a surface share their
/// texels the mean of `light` decides, as in to_map. light [N]. Result [height][width].
std::vector<std::uint32_t> shown_lumels(const Lumels& lumels, std::span<const glm::vec3> light);

/// Writes one value per lumel into the atlas: RGB = value, A = coverage (0 where no surface is,
/// at least 1/255 where one is, so that no covered texel loses its mark in 8 or 16 bits).
/// Where both sides of a surface share their texels these show, chart by chart, the side whose mean
/// value is the brighter one; the mean is by area over what is not buried, and equal sides show the
/// front. With Lumels::shows_front they show the front.
/// values [N]: per lumel, e.g. irradiance [lx].
Image to_map(const Lumels& lumels, std::span<const glm::vec3> values);

/// Gives buried lumels the light of their nearest open neighbours in the same chart, so that
/// filtering never darkens or leaks; a chart that is buried as a whole stays as it is. Where only
/// one side of a double-sided surface is buried, its texel counts as buried if it is black.
/// `layers`: further maps that are filled where `map` is.
void fill_buried(Image& map, const Lumels& lumels, std::span<Image> layers = {});

/// Fills everything uncovered from its nearest covered texels, so that bilinear and mipmapped
/// sampling never sees black. Alpha and covered texels stay as they are.
void dilate(Image& map);

/// How much the two sides of seams differ.
struct SeamGaps {
    double length = 0.0;   ///< of all seams [texels]
    double gap = 0.0;      ///< root mean square over it of |a - b| / max(a, b), sampled bilinearly
    double jumping = 0.0;  ///< share of the length where the light itself jumps, not in `gap`
};

/// Of a map with gutters. What jumps is decided by `judge`, a map of the same seams.
SeamGaps seam_gaps(const Image& map, const Image& judge, const Scene& scene, const Atlas& atlas);

/// Makes both sides of chart borders that share an edge in the world sample alike, within one
/// instance and between neighbours, wherever the surface goes on smoothly. Creases keep their
/// contrast, and so do borders where the light itself jumps (a wall may stand there).
/// `map`: dilated; its gutters are changed most, the outermost covered texels a little.
/// `layers`: further maps, matched along the same seams; only `map` is kept from falling below 0.
void match_seams(Image& map, const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                 std::span<Image> layers = {});

/// Bytes that finish_map takes for a while, beside the map.
std::uint64_t finish_bytes(const Atlas& atlas);

}  // namespace lumel
