#pragma once
// The triangles that can block light, ready to be drawn.

#include <cstdint>
#include <vector>

#include "atlas/packing/atlas.h"
#include "scene/values/scene.h"

namespace lumel {

/// A range of indices. Its first triangles can stand between two points of the scene, and of these
/// the first never move; the rest lie on the scene's hull and hide only what is outside.
struct OccluderRange {
    std::uint32_t first_index = 0;
    std::uint32_t still_count = 0;
    std::uint32_t inner_count = 0;  ///< still_count among them
    std::uint32_t index_count = 0;  ///< of all, inner_count among them
};

/// One material's triangles that let light through in places.
struct CutOut {
    int material = 0;
    OccluderRange range;
};

/// An indexed triangle list: opaque triangles first, then one range for each cut-out material.
struct Occluders {
    std::vector<glm::vec3> positions;      ///< [V] instance frame [m]
    std::vector<std::uint32_t> instances;  ///< [V] whose frame
    std::vector<glm::vec3> look;           ///< [V] (u, v, alpha factor) for cut-outs
    std::vector<glm::vec2> place;          ///< [V] in the atlas [texels]; empty without one
    std::vector<glm::vec4> chart;          ///< [V] its chart's corners there, low and high
    std::vector<std::uint32_t> indices;    ///< [3T]
    OccluderRange opaque;
    std::vector<CutOut> cut_outs;

    /// [3T] of all triangles that can stand between two points of the scene.
    std::vector<std::uint32_t> inner_indices() const;
};

/// Collects all triangles. Those that have the whole scene and its lamps on one side of their plane
/// are its hull: the outer walls of a room hide no point of it from another. `with_hull`: false
/// where instances will move, which makes every triangle an inner one.
/// `atlas`: if given, vertices are split at chart borders and have their place. Corners go around
/// a triangle counter-clockwise where it is seen from its front, mirrored instances' too.
Occluders find_occluders(const Scene& scene, const std::vector<char>& movers = {},
                         const Atlas* atlas = nullptr);

}  // namespace lumel
