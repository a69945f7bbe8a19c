#pragma once
// Lumel's members of extras.

namespace lumel {

class JsonView;

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

}  // namespace lumel
