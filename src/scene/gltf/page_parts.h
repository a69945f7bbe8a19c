#pragma once
// Baked glTF primitives that are parts of one, with charts on several pages of the lightmap. Parts
// share vertices; each has its own indices and material. Marks in their extras let later bakes and
// corrections join them in the original order of triangles.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/json/json_view.h"

namespace lumel {

/// A part of a primitive.
struct PagePart {
    std::size_t whole = 0;  ///< index of the original primitive in the mesh
    int page = 0;
};

/// Marks a primitive as a part.
void mark_part(Json& primitive, const PagePart& part);

/// Stores the order of the parts' triangles in the first of them. of_triangle: part indices, in
/// mesh order.
void mark_order(Json& primitive, const std::vector<std::uint32_t>& of_triangle);

/// True for a marked primitive.
bool is_part(const Json& primitive);

/// Removes these marks and those of join_pages().
void erase_part_marks(Json& primitive);

/// Joins parts whose marks are consistent: the first refers to the indices of the others, for
/// joined_parts(). `gltf` may be any JSON object. Call after join_sides.
void join_pages(Json& gltf);

/// Accessors of the indices that a joined primitive takes from its parts.
std::vector<std::size_t> accessors_of_parts(const Json& primitive);

/// The parts of a joined primitive.
struct JoinedParts {
    /// Consecutive triangles, both in a part and in the whole.
    struct Run {
        std::size_t part = 0, triangles = 0;
    };
    std::vector<JsonView> indices;     ///< [parts] index of an accessor
    std::vector<std::uint16_t> pages;  ///< [parts]
    std::vector<Run> runs;             ///< in the order of the whole
};
/// Empty if the primitive is not joined. Throws Error{input} if the marks are invalid; the caller
/// checks that the runs match the lengths of the parts.
JoinedParts joined_parts(const JsonView& primitive);

}  // namespace lumel
