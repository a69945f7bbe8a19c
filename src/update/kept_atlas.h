#pragma once
// The atlas of a bake, found again in its files, and made to hold an edited scene.

#include <vector>

#include "atlas/atlas.h"
#include "update/matches.h"

namespace lumel {

/// Number of the chart that each texel belongs to, kNoChart where none.
using ChartMap = std::vector<std::uint32_t>;  // [height][width]
inline constexpr std::uint32_t kNoChart = ~0u;

/// The atlas of side × side texels that `scene`, as written by write_scene_glb, has in TEXCOORD_1.
/// charts: of the same atlas. Throws Error{input} if the scene has no such coordinates.
Atlas written_atlas(const Scene& scene, int side, float texels_per_metre, const ChartMap& charts);

/// An atlas for the edited scene: what was there before keeps its texels; what is new gets a place
/// where there is room, beside the rest if there is none. Throws Error{input} if it gets too large.
Atlas kept_atlas(const Scene& before, const Atlas& atlas, const Scene& after,
                 const Matches& matches, int gutter);

}  // namespace lumel
