#pragma once
// Double-sided surfaces in a baked glTF. If the sides have separate light and texels, they are two
// single-sided primitives; marks in their extras let later bakes and corrections join them.

#include "base/json/json_file.h"

namespace lumel {

enum class MarkedSide { front, back };

/// Marks one of the two primitives of a double-sided surface.
void mark_side(Json& primitive, MarkedSide side);

/// Joins marked primitives: removes backs and makes the materials of fronts double-sided. `gltf`
/// may be any JSON object.
void join_sides(Json& gltf);

}  // namespace lumel
