#pragma once
// Gives every baked primitive of every instance its own mesh entry.

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

/// No texture uses the old TEXCOORD_1.
inline constexpr int kNotMoved = -1;

/// A primitive of the file that is baked for one instance, or its part on one page.
struct BakedPrimitive {
    const Surface* surface = nullptr;
    /// The surface with the light of its back in texels of its own, or null.
    std::shared_ptr<const Surface> back;
    /// Triangles of the surface on `page` if not all are; else empty.
    std::vector<std::uint32_t> triangles;
    std::size_t part = 0;                       ///< index among the surface's parts, by page
    std::size_t node = 0;                       ///< index into the file's nodes
    std::size_t mesh = 0;                       ///< index into the file's meshes
    std::size_t primitive = 0;                  ///< index into that mesh's primitives
    int page = 0;                               ///< page of the map
    int moved_texcoord = kNotMoved;             ///< new number of the old TEXCOORD_1
    std::optional<std::size_t> material;        ///< in the file; after separate_materials: its copy
    std::vector<std::size_t> file_materials;    ///< its file materials, with variants'
    std::map<std::size_t, std::size_t> copies;  ///< file material to its copy
};

/// The primitives of the atlas, in its order. Throws Error{input} if the file is not the one that
/// the scene was read from.
std::vector<BakedPrimitive> list_baked_primitives(const GltfDocument& document, const Scene& scene,
                                                  const Atlas& atlas);

/// Empties primitives that are baked in all uses, so that their data can be released.
void cut_baked_primitives(Json& json, const std::vector<BakedPrimitive>& baked);

/// Vertex attributes of the triangle lists.
enum class Attributes {
    all,      ///< those of the file
    visible,  ///< without tangents, colours and texture coordinates that the material does not read
};

/// Adds the split triangle lists: a mesh per instance, bound to its node. If the map has both
/// sides, the front is single-sided, and its turned copy follows at the end of the mesh. Parts on
/// further pages also follow there, with the vertices of the first.
void place_baked_primitives(GlbBuilder& builder, const std::vector<BakedPrimitive>& baked,
                            const Atlas& atlas, Attributes kept);

}  // namespace lumel
