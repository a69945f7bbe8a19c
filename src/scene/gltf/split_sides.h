#pragma once
// Double-sided surfaces in a baked glTF. Where the sides have different light, and texels of their
// own, they are two single-sided primitives; marks in their extras tell a later bake, or a
// correction, that they are one.

#include "base/json/json_file.h"

namespace lumel {

enum class MarkedSide { front, back };

/// Marks one of two primitives that are the sides of one surface.
void mark_side(Json& primitive, MarkedSide side);

/// Makes them one again, where a document has marks: backs are left out, materials of fronts are
/// double-sided. `gltf` may be any JSON object.
void join_sides(Json& gltf);

}  // namespace lumel
