#pragma once
// Links that outlive the program, and what tells whether they still hold.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

/// All that a later run needs to light the same lumels over the same links: of a scene with N
/// lumels and I instances. Nothing in it depends on lamps, sky or paint.
struct StoredLinks {
    std::string scene_hash;                ///< Scene::hash of what was baked
    std::uint32_t rays = 0;                ///< of a lumel
    std::uint32_t seed = 0;                ///< of their directions
    float ray_offset = 0.0f;               ///< how far off surfaces they started [m]
    std::vector<std::uint64_t> lumels;     ///< [N] lumel_hashes()
    std::vector<std::uint64_t> instances;  ///< [I] instance_hashes()
    std::vector<std::uint32_t> links;      ///< [N][rays] as of LumelLinks

    /// Places in the atlas as they were: in scene.glb they are rounded.
    struct StoredTexcoords {
        std::vector<glm::vec2> texcoord;   ///< [V] as of Surface
        std::vector<std::uint32_t> chart;  ///< [T] as of Surface
        std::uint32_t authored = 0;        ///< 1: as of Surface

        template <class Archive>
        void state(Archive& archive)
        {
            archive(texcoord, chart, authored);
        }
    };
    std::vector<StoredTexcoords> sheets;  ///< of the atlas's surfaces
    std::uint32_t side = 0;               ///< of the atlas [texels]
    float texels_per_metre = 0.0f;
    std::uint32_t charts = 0;
    std::vector<glm::ivec2> back_shift;  ///< as of Atlas
    std::uint32_t shows_front = 0;       ///< 1: as of Atlas

    /// Where links end: at lumels, in the sky, nowhere, or lost on an instance.
    std::uint64_t ends() const { return lumels.size() + 2 + instances.size(); }
    /// What a link that was renumbered ended on is no longer there. No file has such links.
    std::uint64_t gone() const { return ends(); }
};

/// Are so many rays of a lumel a grid that Lumel keeps?
constexpr bool is_grid(std::uint32_t rays)
{
    return rays == 4 || rays == 16 || rays == 64 || rays == 256;
}

/// Side of the grid of a lumel's rays. Throws Error{input} unless there are 4, 16, 64 or 256.
std::uint32_t side_of_rays(std::uint32_t rays);

/// What lumels and instances that were kept are now: by their number then. kNotThere: gone.
struct Renumbering {
    static constexpr std::uint32_t kNotThere = ~0u;

    std::vector<std::uint32_t> lumels;     ///< [N]
    std::vector<std::uint32_t> instances;  ///< [I]
    std::size_t lumels_now = 0, instances_now = 0;
};

/// The same links between lumels and instances that have other numbers now. Those that are new
/// have a print of 0, as if they had changed; links that ended on what is gone end in gone().
/// Places are left out.
StoredLinks renumbered(const StoredLinks& kept, const Renumbering& now);

/// Takes over the places of an atlas.
void keep_places(const Atlas& atlas, StoredLinks& kept);

/// The atlas whose places were kept. scene: as write_scene_glb wrote it from that atlas.
/// pages: that it was written as. Throws Error{input} if it has other surfaces or another size.
Atlas atlas_of(const StoredLinks& kept, const Scene& scene, const Pages& pages);

}  // namespace lumel
