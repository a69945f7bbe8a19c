#pragma once
// Which of the links that were kept a scene may have changed.

#include <cstdint>
#include <vector>

#include "base/core/box.h"
#include "links/kept/stored_links.h"
#include "links/live/link_context.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// [N] Of where each lumel's rays start: its place, and what is open of it.
std::vector<std::uint64_t> lumel_hashes(const WorldLumels& world, const Lumels& lumels);

/// [I] Of what rays meet of each instance: its triangles in their place, and where they let light
/// pass.
std::vector<std::uint64_t> instance_hashes(const Scene& scene);

/// Of a scene against links that were kept.
struct LinkChanges {
    /// An instance that is elsewhere or otherwise.
    struct Moved {
        RayScene tree;
        Box box;
    };

    bool all = true;           ///< nothing fits: the rest is empty
    std::vector<char> starts;  ///< [N] its links start elsewhere
    std::vector<char> ends;    ///< [ends] links that ended there may end elsewhere
    std::vector<Moved> moved;  ///< links may meet it where it is now
};
/// rays, seed: that are wanted.
LinkChanges changes_since(const StoredLinks& kept, const LinkContext& place, std::uint32_t rays,
                          std::uint32_t seed);

}  // namespace lumel
