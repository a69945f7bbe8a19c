#pragma once
// What Lumel reads of extras.

#include "base/json/json_view.h"

namespace lumel {

/// Of a lightmap.
inline constexpr int kMaxPages = 256;

/// extras.lumel.texels_per_metre of a node, mesh or material: the density of its lightmap; 0 if it
/// has none. Throws Error{input} if it is not a positive number.
float density_in_extras(const JsonView& object);

/// extras.lumel.probe of a node: is a light probe wanted there? Throws Error{input} if it is
/// neither true nor false.
bool is_probe_in_extras(const JsonView& node);

/// extras.lumel.page of a material: the page of the lightmap that shows it, as a bake of several
/// wrote it; else 0. Throws Error{input} if it is no such number.
int page_in_extras(const JsonView& material);

}  // namespace lumel
