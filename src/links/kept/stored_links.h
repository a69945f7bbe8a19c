#pragma once
// Links stored on disk, with hashes that show which of them are still valid.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

/// Everything needed to relight the lumels over stored links, for a scene of N lumels and I
/// instances. Independent of lamps, sky and albedo overrides.
struct StoredLinks {
    std::string scene_hash;                ///< Scene::hash of the baked scene
    std::uint32_t rays = 0;                ///< rays per lumel
    std::uint32_t seed = 0;                ///< seeds ray directions
    float ray_offset = 0.0f;               ///< distance of ray origins from surfaces [m]
    std::vector<std::uint64_t> lumels;     ///< [N] lumel_hashes()
    std::vector<std::uint64_t> instances;  ///< [I] instance_hashes()
    std::vector<std::uint32_t> links;      ///< [N][rays] as of LumelLinks

    /// Unrounded texture coordinates; scene.glb has rounded ones.
    struct StoredTexcoords {
        std::vector<glm::vec2> texcoord;   ///< [V] as in Surface
        std::vector<std::uint32_t> chart;  ///< [T] as in Surface
        std::uint32_t authored = 0;        ///< 1: as in Surface

        template <class Archive>
        void state(Archive& archive)
        {
            archive(texcoord, chart, authored);
        }
    };
    std::vector<StoredTexcoords> sheets;  ///< one per surface of the atlas
    std::uint32_t side = 0;               ///< side of the atlas [texels]
    float texels_per_metre = 0.0f;
    std::uint32_t charts = 0;
    std::vector<glm::ivec2> back_shift;  ///< as in Atlas
    std::uint32_t shows_front = 0;       ///< 1: as in Atlas

    /// Number of possible ends of a link: lumels, sky, absorbed, absorbed on an instance.
    std::uint64_t ends() const { return lumels.size() + 2 + instances.size(); }
    /// End of a renumbered link whose target was removed. Never in a file.
    std::uint64_t gone() const { return ends(); }
};

/// True for the supported ray counts 4, 16, 64 and 256.
constexpr bool is_grid(std::uint32_t rays)
{
    return rays == 4 || rays == 16 || rays == 64 || rays == 256;
}

/// Side of the grid of a lumel's rays. Throws Error{input} unless `rays` is 4, 16, 64 or 256.
std::uint32_t side_of_rays(std::uint32_t rays);

/// New numbers of stored lumels and instances, by old number. kNotThere: removed.
struct Renumbering {
    static constexpr std::uint32_t kNotThere = ~0u;

    std::vector<std::uint32_t> lumels;     ///< [N]
    std::vector<std::uint32_t> instances;  ///< [I]
    std::size_t lumels_now = 0, instances_now = 0;
};

/// The links with lumels and instances renumbered. New lumels and instances have hash 0, as if
/// changed; links to removed ones end in gone(). Leaves out texture coordinates.
StoredLinks renumbered(const StoredLinks& kept, const Renumbering& now);

/// Copies the texture coordinates of an atlas.
void keep_places(const Atlas& atlas, StoredLinks& kept);

/// The atlas with the stored texture coordinates. scene: as write_scene_glb wrote it from that
/// atlas. pages: of that atlas. Throws Error{input} if its surfaces or size differ.
Atlas atlas_of(const StoredLinks& kept, const Scene& scene, const Pages& pages);

}  // namespace lumel
