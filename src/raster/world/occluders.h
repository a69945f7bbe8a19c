#pragma once
// The triangles that can block light, for rasterisation.

#include <cstdint>
#include <vector>

#include "atlas/packing/atlas.h"
#include "scene/values/scene.h"

namespace lumel {

/// A range of indices: first inner triangles, which can block light between two points of the
/// scene, static ones first; then those on the scene's hull, which only hide the outside.
struct OccluderRange {
    std::uint32_t first_index = 0;
    std::uint32_t still_count = 0;
    std::uint32_t inner_count = 0;  ///< inner triangles, including still_count
    std::uint32_t index_count = 0;  ///< all, including inner_count
};

/// The triangles of a material that transmits light.
struct CutOut {
    int material = 0;
    OccluderRange range;
};

/// An indexed triangle list: opaque triangles, then one range per cut-out material.
struct Occluders {
    std::vector<glm::vec3> positions;      ///< [V] in the instance's frame [m]
    std::vector<std::uint32_t> instances;  ///< [V] index of the instance
    std::vector<glm::vec3> look;           ///< [V] (u, v, alpha factor) for cut-outs
    std::vector<glm::vec2> place;          ///< [V] atlas position [texels]; empty without an atlas
    std::vector<glm::vec4> chart;        ///< [V] rectangle of its chart there, low and high corner
    std::vector<std::uint32_t> indices;  ///< [3T]
    OccluderRange opaque;
    std::vector<CutOut> cut_outs;

    /// [3T] indices of all inner triangles.
    std::vector<std::uint32_t> inner_indices() const;
};

/// Collects all triangles. Those with the whole scene and its lamps on one side of their plane are
/// on its hull: the outer walls of a room do not occlude its points. Movable instances make every
/// triangle an inner one. `atlas`: optional; vertices are then split at chart borders and have
/// atlas positions. Corners are counter-clockwise seen from the front, even on mirrored instances.
Occluders find_occluders(const Scene& scene, const std::vector<char>& movers = {},
                         const Atlas* atlas = nullptr);

}  // namespace lumel
