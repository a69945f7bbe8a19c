#pragma once
// Lumel's members of extras.

#include <cstddef>
#include <functional>
#include <optional>

#include "base/json/json_view.h"

namespace lumel {

/// The member that holds what glTF does not define.
inline constexpr const char* kExtras = "extras";

/// Maximum pages of a lightmap.
inline constexpr int kMaxPages = 256;

/// extras.lumel.texels_per_metre of a node, mesh or material: its texel density; 0 if absent.
/// Throws Error{input} if it is not a positive number.
float density_in_extras(const JsonView& object);

/// extras.lumel.probe of a node: true if a light probe is wanted there. Throws Error{input} if it
/// is not a boolean.
bool is_probe_in_extras(const JsonView& node);

/// extras.lumel.page of a material: its lightmap page, written by a bake with several; else 0.
/// Throws Error{input} if it is invalid.
int page_in_extras(const JsonView& material);

/// asset.extras.lumel.lamps.bufferView: the maps of lamps in scene.glb, written by a bake with
/// --per-lamp; empty if absent.
std::optional<std::size_t> lamps_view_in_extras(const Json& gltf);
/// Erases asset.extras.lumel.lamps.
void forget_lamps(Json& gltf);

/// A member of an object's extras; null if there is none.
const Json* in_extras(const Json& object, const char* key);
/// An object's extras, to add members to. Extras that are no object move to their member "value".
Json& extras_of(Json& object);
/// Erases a member of an object's extras, and then empty extras.
void erase_from_extras(Json& object, const char* key);

/// Visits the list of primitives of each mesh that has one.
void for_primitive_lists(Json& gltf, const std::function<void(Json& primitives)>& visit);

}  // namespace lumel
