#pragma once
// Restores the atlas of a bake from its files, and extends it for an edited scene.

#include <vector>

#include "atlas/packing/atlas.h"
#include "jobs/edit/matches.h"

namespace lumel {

inline constexpr std::uint32_t kNoChart = ~0u;

/// The charts of a bake.
struct StoredCharts {
    std::vector<std::uint32_t> of_texel;  ///< [height][width] chart number, or kNoChart
    std::vector<glm::ivec2> back_shift;   ///< [charts] as in Atlas
    bool shows_front = false;             ///< as in Atlas
};

/// The atlas with these pages in TEXCOORD_1 of `scene`, as written by write_scene_glb.
/// charts: of the same atlas. Throws Error{input} if the scene lacks such coordinates, or the
/// charts do not match.
Atlas written_atlas(const Scene& scene, const Pages& pages, float texels_per_metre,
                    const StoredCharts& charts);

/// Atlas for the edited scene: existing objects keep their texels; new ones are placed in free
/// space, or beside the rest; their sides share texels. Throws Error{input} if it becomes too
/// large.
Atlas kept_atlas(const Scene& before, const Atlas& atlas, const Scene& after,
                 const Matches& matches, int gutter);

}  // namespace lumel
