#pragma once
// Primitives of a baked glTF that are parts of one, whose charts lie on several pages of the
// lightmap. The parts share their vertices, each has indices and a material of its own; marks in
// their extras tell a later bake, or a correction, that they are one, and in what order their
// triangles were.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/json/json_view.h"

namespace lumel {

/// A part of a primitive, with its triangles in their order.
struct PagePart {
    std::size_t whole = 0;  ///< number that the parts of one primitive have in common in a mesh
    int page = 0;
};

/// Marks one of them.
void mark_part(Json& primitive, const PagePart& part);

/// Tells the first of them which triangles of the whole each has. of_triangle: numbers of parts,
/// in the order in which they stand in the mesh.
void mark_order(Json& primitive, const std::vector<std::uint32_t>& of_triangle);

/// Takes marks off, and those of what join_pages() has joined.
void erase_part_marks(Json& primitive);

/// Makes parts one again, where a document has marks and they fit: the first takes the indices of
/// the others, which joined_parts() finds. `gltf` may be any JSON object. Call after join_sides.
void join_pages(Json& gltf);

/// Accessors of the indices that a joined primitive takes from its parts.
std::vector<std::size_t> accessors_of_parts(const Json& primitive);

/// What a joined primitive is made of.
struct JoinedParts {
    /// Triangles that follow each other in a part and in the whole.
    struct Run {
        std::size_t part = 0, triangles = 0;
    };
    std::vector<JsonView> indices;     ///< [parts] index of an accessor
    std::vector<std::uint16_t> pages;  ///< [parts]
    std::vector<Run> runs;             ///< that make up the whole
};
/// Empty for what is not joined. Throws Error{input} where it is not sound; whether the runs are
/// as long as the parts is left to the caller.
JoinedParts joined_parts(const JsonView& primitive);

}  // namespace lumel
