#pragma once
// From solved lumels to a map for filtered sampling. Order: to_map, fill_buried, dilate,
// match_seams; finish_map does all four.

#include <span>
#include <vector>

#include "atlas/packing/atlas.h"
#include "base/core/image.h"

namespace lumel {

/// A map of `values` without black gutters, buried texels or seams.
Image finish_map(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                 std::span<const glm::vec3> values);

/// Maps of both sides of all surfaces.
struct SideMaps {
    Image front;
    Image back;  ///< equals `front` for single-sided surfaces; empty if there are no others
};

/// Applies finish_map to each side instead of the brighter one.
SideMaps finish_sides(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                      std::span<const glm::vec3> values);

/// Finished maps of a solution.
struct FinishedMaps {
    Image light;
    std::vector<Image> layers;
};

/// Finishes `light` and related quantities, such as coefficients of its directions. `light` decides
/// for all which side is shown, which texels are black and where seams are matched; layers may be
/// negative. light [N], layers [L][N].
FinishedMaps finish_maps(const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                         std::span<const glm::vec3> light,
                         std::span<const std::vector<glm::vec3>> layers);

/// The visible lumel of each texel [height][width], or kNoLumel: if both sides share the texel,
/// `light` decides, as values do in to_map. light [N].
std::vector<std::uint32_t> shown_lumels(const Lumels& lumels, std::span<const glm::vec3> light);

/// Writes one value per lumel into the atlas: RGB = value, A = coverage (0 outside surfaces, else
/// at least 1/255, so that covered texels remain marked in 8 or 16 bits). If both sides of a
/// surface share their texels, each chart shows the side of the larger mean square, by area over
/// open lumels; equal sides show the front. With Lumels::shows_front they show the front. values
/// [N]: per lumel, e.g. irradiance [lx].
Image to_map(const Lumels& lumels, std::span<const glm::vec3> values);
/// The same for the lumels of `shown`, by shown_lumels().
Image to_map(const Lumels& lumels, std::span<const std::uint32_t> shown,
             std::span<const glm::vec3> values);

/// Fills buried lumels with the light of their nearest open neighbours in the same chart, so that
/// filtering neither darkens nor leaks. Wholly buried charts are unchanged. shown: by
/// shown_lumels(). `layers`: further maps, filled at the same texels.
void fill_buried(Image& map, const Lumels& lumels, std::span<const std::uint32_t> shown,
                 std::span<Image> layers = {});

/// Fills uncovered texels from their nearest covered ones, so that bilinear and mipmapped sampling
/// never reads black. Alpha and covered texels are unchanged.
void dilate(Image& map);

/// Differences between the two sides of seams.
struct SeamGaps {
    double length = 0.0;   ///< total length of seams [texels]
    double gap = 0.0;      ///< RMS over it of |a - b| / max(a, b), sampled bilinearly
    double jumping = 0.0;  ///< share of the length with a discontinuity of the light, not in `gap`
};

/// Measures a map with gutters. `judge`: a map of the same seams that defines discontinuities.
SeamGaps seam_gaps(const Image& map, const Image& judge, const Scene& scene, const Atlas& atlas);

/// Makes both sides of chart borders that share an edge in the world equal under sampling, within
/// an instance and between neighbours, if the surface is smooth there. Keeps the contrast of
/// creases and of discontinuities of the light (a wall may be there). `map`: dilated; changes
/// mostly its gutters, and the outermost covered texels a little. `layers`: further maps, matched
/// along the same seams; only `map` is clamped at 0.
void match_seams(Image& map, const Scene& scene, const Atlas& atlas, const Lumels& lumels,
                 std::span<Image> layers = {});

/// Temporary memory of finish_map beside the map [bytes].
std::uint64_t finish_bytes(const Atlas& atlas);

}  // namespace lumel
