#pragma once
// Links stored on disk, with hashes that show which of them are still valid.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"
#include "base/core/box.h"
#include "links/direct/solutions.h"
#include "links/kept/link_table.h"
#include "links/kept/ray_guide.h"

namespace lumel {

/// An error that a bake has a target for: of all lumels, of dark ones, relative to the light
/// around, or visible noise of a chart.
enum class ErrorOf : std::uint8_t { all, dark, eye, chart };

/// Ends of all rays of a bake, to light its scene again, or an edited one. N lumels, I instances.
/// Independent of lamps, sky, colours and emission; only guide, numbers of rays and passes follow
/// the light of the bake.
struct StoredLinks {
    /// Rays of each lumel in a round [solutions][N].
    using RayCounts = std::array<std::vector<std::uint16_t>, kSolutions>;

    /// Rays traced in one round of a bake.
    struct Round {
        double mean = 0.0;  ///< rays per lumel in each solution
        RayCounts rays;
        /// [solutions][rays of all lumels] The numbers are those of LinkNumbers(I, N), with lumels
        /// in place of sub-lumels. LinkNumbers::kNear: to be traced again.
        std::array<std::vector<LinkEnd>, kSolutions> ends;

        /// Without the ends, which a file packs.
        template <class Archive>
        void state(Archive& archive)
        {
            archive(mean, rays);
        }
    };

    /// Shadow rays that a bake added where direct light varied most.
    struct Pass {
        std::uint32_t rounds = 0;          ///< rounds of links before it
        ErrorOf aim = ErrorOf::all;        ///< the error that it lowered
        double before = 0.0;               ///< that error by direct light, squared, before the pass
        std::vector<std::uint8_t> levels;  ///< [N] DirectEstimator::levels()

        /// True for a pass of `count` lumels after at most `most` rounds.
        bool fits(std::size_t count, std::size_t most) const;
        template <class Archive>
        void state(Archive& archive)
        {
            archive(rounds, aim, before, levels);
        }
    };

    std::string scene_hash;                ///< Scene::hash of the baked scene
    std::uint32_t seed = 0;                ///< LinksOptions::seed
    std::uint8_t shared_directions = 0;    ///< not 0: all lumels draw from one set
    float ray_offset = 0.0f;               ///< distance of ray origins from surfaces [m]
    std::vector<std::uint64_t> lumels;     ///< [N] lumel_hashes()
    std::vector<std::uint64_t> instances;  ///< [I] instance_hashes()
    std::vector<Box> boxes;                ///< [I] bounds of the instances [m]
    RayGuide guide;                        ///< of the rounds after the first
    std::vector<Round> rounds;
    std::vector<Pass> passes;  ///< in the order of the bake
    std::vector<Box> gone;     ///< bounds of removed instances; never in a file
    bool reordered = false;    ///< instances have other numbers than in the file

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
    std::vector<std::uint8_t> inner;  ///< [charts] bits of Atlas::inner: 1 front, 2 back; or empty
    std::uint32_t shows_front = 0;    ///< 1: as in Atlas

    /// Throws Error{input} if there are too many.
    LinkNumbers numbers() const { return {instances.size(), lumels.size()}; }
    /// Rays per lumel in all solutions and rounds.
    std::uint64_t shots() const;
};

/// [N + 1] Index of the first ray of each lumel, given their numbers of rays [N].
std::vector<std::size_t> first_rays(const std::vector<std::uint16_t>& rays);

/// New numbers of stored lumels and instances, by old number. kNotThere: removed.
struct Renumbering {
    static constexpr std::uint32_t kNotThere = ~0u;

    std::vector<std::uint32_t> lumels;     ///< [N]
    std::vector<std::uint32_t> instances;  ///< [I]
    std::size_t lumels_now = 0, instances_now = 0;
};

/// The links with lumels and instances renumbered. New lumels and instances have hash 0, as if
/// changed; their rays, and those that ended on removed ones, are to be traced again. Leaves out
/// texture coordinates.
StoredLinks renumbered(const StoredLinks& kept, const Renumbering& now);

/// Copies what an atlas adds to the triangles of the scene: texture coordinates, charts, sides.
void keep_places(const Atlas& atlas, StoredLinks& kept);

/// The atlas that keep_places() stored. scene: as write_scene_glb wrote it from that
/// atlas. pages: of that atlas. Throws Error{input} if its surfaces or size differ.
Atlas atlas_of(const StoredLinks& kept, const Scene& scene, const Pages& pages);

}  // namespace lumel
