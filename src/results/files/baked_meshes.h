#pragma once
// Giving every baked primitive of every instance a mesh entry of its own.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "atlas/packing/atlas.h"
#include "results/files/glb_builder.h"
#include "scene/values/scene.h"

namespace lumel {

/// The old TEXCOORD_1 is not needed by any texture.
inline constexpr int kNotMoved = -1;

/// A primitive of the file that is baked for one instance, or the part of it on one page.
struct BakedPrimitive {
    const Surface* surface = nullptr;
    /// Where the map has light of its back in texels of its own, or null.
    std::shared_ptr<const Surface> back;
    /// Of the surface that lie on `page`, where not all do; else empty.
    std::vector<std::uint32_t> triangles;
    std::size_t part = 0;                       ///< of the surface's, page by page
    std::size_t node = 0;                       ///< index into the file's nodes
    std::size_t mesh = 0;                       ///< index into the file's meshes
    std::size_t primitive = 0;                  ///< index into that mesh's primitives
    int page = 0;                               ///< of the map
    int moved_texcoord = kNotMoved;             ///< new number of the old TEXCOORD_1
    std::optional<std::size_t> material;        ///< in the file; after separate_materials: its copy
    std::vector<std::size_t> file_materials;    ///< the same and those of its variants
    std::map<std::size_t, std::size_t> copies;  ///< file material to its copy
};

/// What the atlas covers, in its order. Throws Error{input} if the file is not the one that the
/// scene was read from.
std::vector<BakedPrimitive> list_baked_primitives(const GltfDocument& document, const Scene& scene,
                                                  const Atlas& atlas);

/// Empties primitives whose every use is baked, so that their data can be released.
void cut_baked_primitives(Json& json, const std::vector<BakedPrimitive>& baked);

/// Puts the split triangle lists in: a mesh per instance, bound to its node. Where the map has both
/// sides the front is single-sided, and a turned copy of it follows at the end of the mesh. Parts
/// on further pages follow there too, with the vertices of the first.
void place_baked_primitives(GlbBuilder& builder, const std::vector<BakedPrimitive>& baked,
                            const Atlas& atlas);

}  // namespace lumel
