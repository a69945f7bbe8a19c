#pragma once
// The atlas of a bake, found again in its files, and made to hold an edited scene.

#include <vector>

#include "atlas/packing/atlas.h"
#include "jobs/edit/matches.h"

namespace lumel {

inline constexpr std::uint32_t kNoChart = ~0u;

/// The charts of a bake.
struct StoredCharts {
    std::vector<std::uint32_t> of_texel;  ///< [height][width] number, kNoChart where there is none
    std::vector<glm::ivec2> back_shift;   ///< [charts] as of the atlas
    bool shows_front = false;             ///< as of the atlas
};

/// The atlas of these pages that `scene`, as written by write_scene_glb, has in TEXCOORD_1.
/// charts: of the same atlas. Throws Error{input} if the scene has no such coordinates, or the
/// charts are of another atlas.
Atlas written_atlas(const Scene& scene, const Pages& pages, float texels_per_metre,
                    const StoredCharts& charts);

/// An atlas for the edited scene: what was there before keeps its texels; what is new gets a place
/// where there is room, beside the rest if there is none; its sides share their texels. Throws
/// Error{input} if it gets too large.
Atlas kept_atlas(const Scene& before, const Atlas& atlas, const Scene& after,
                 const Matches& matches, int gutter);

}  // namespace lumel
