#pragma once
// Finds the stored links that scene changes can invalidate.

#include <cstdint>
#include <vector>

#include "atlas/near/world_lumels.h"
#include "atlas/prepare/solve_scene.h"
#include "base/core/box.h"
#include "links/kept/stored_links.h"
#include "rays/cast/ray_scene.h"

namespace lumel {

/// [N] Hash of each lumel's position and pieces; differs if its ray origins do.
std::vector<std::uint64_t> lumel_hashes(const WorldLumels& world, const Lumels& lumels);

/// [I] Hash of each instance's world-space triangles and transmission.
std::vector<std::uint64_t> instance_hashes(const Scene& scene);

/// [I] Bounds of each instance [m].
std::vector<Box> instance_boxes(const Scene& scene);

/// Changes of a scene since its links were stored.
struct LinkChanges {
    /// A moved or changed instance.
    struct Moved {
        RayScene tree;
        Box box;
        bool blends;  ///< rays pass it by chance
    };

    bool all = true;           ///< nothing is reusable: the rest is empty
    std::vector<char> starts;  ///< [N] the lumel's ray origins changed
    std::vector<char> ends;    ///< [numbers of StoredLinks] links with this end can change
    std::vector<Moved> moved;  ///< links can now hit these
};
LinkChanges changes_since(const StoredLinks& kept, const SolveScene& scene,
                          const WorldLumels& world, std::uint32_t seed);

}  // namespace lumel
