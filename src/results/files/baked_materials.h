#pragma once
// Materials of baked primitives.

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "results/files/baked_meshes.h"

namespace lumel {

/// The file's materials of a primitive: its own, then those of its variants.
std::vector<std::size_t> materials_of(const Json& primitive);

/// Calls visit(mapping) for each KHR_materials_variants mapping of a primitive.
template <class Value, class Visit>
void for_variants(Value& primitive, const Visit& visit)
{
    const char* kVariants = "KHR_materials_variants";
    if (!primitive.contains("extensions") || !primitive["extensions"].contains(kVariants))
        return;
    for (auto& mapping : primitive["extensions"][kVariants].at("mappings"))
        visit(mapping);
}

/// Numbers n of the TEXCOORD_n that the material's textures use, without an older lightmap.
std::set<int> texcoords_read_by(const Json& material);

/// Gives every baked primitive materials that no unbaked one uses, copied only where needed, with
/// texture coordinates renumbered as the primitive requires. Fills `copies` and `material` of
/// `baked`; returns all materials, by page. Call after cut_baked_primitives.
std::vector<std::vector<std::size_t>> separate_materials(Json& json,
                                                         std::vector<BakedPrimitive>& baked);

/// Textures that only lightmaps of an earlier bake used, and whose images no other texture uses.
/// Call after separate_materials.
std::vector<std::size_t> outdated_lightmaps(const Json& json, const Json& original);

/// Binds the lightmap by MOZ_lightmap. intensity: irradiance of a white texel [lx].
void bind_lightmap(Json& json, const std::vector<std::size_t>& materials, std::size_t texture,
                   float intensity);

/// Names the map [lx] in the extras of materials, for viewers of files without MOZ_lightmap.
void tell_of_lightmap(Json& json, const std::vector<std::size_t>& materials, const Pages& pages,
                      int page);

/// Makes the materials black and everything else core glTF: removes extensions, and textures and
/// images that are then unused. Call before the builder releases.
void reduce_to_core(Json& json, const std::vector<std::vector<std::size_t>>& materials);

/// Removes all extensions except those that a kept texture needs.
void erase_extensions(Json& json);

/// Makes black materials emit the texture.
void bind_emission(Json& json, const std::vector<std::size_t>& materials, std::size_t texture);

/// Updates extensionsUsed and extensionsRequired to the names in use, without unused ones of
/// `original`.
void list_extensions(Json& json, const Json& original);

}  // namespace lumel
