#pragma once
// Meshes of a glTF file as valid triangle lists.

#include "scene/gltf/document.h"
#include "scene/values/scene.h"

namespace lumel {

/// Statistics for warnings.
struct MeshNotes {
    std::size_t vertices = 0;             ///< read so far
    std::size_t zero_area_triangles = 0;  ///< dropped
    std::size_t stray_indices = 0;        ///< left over after the last whole triangle
    std::size_t points_and_lines = 0;     ///< primitives skipped
    std::size_t repaired_normals = 0;     ///< NaN or zero length, replaced by those of their faces
    std::size_t morphed_meshes = 0;       ///< with morph targets, read at their default weights
};

/// Reads json["meshes"][mesh]. Omits primitives without triangles; those without a material get
/// `default_material`. Throws Error{input}.
Mesh read_mesh(const GltfDocument& document, std::size_t mesh, int default_material,
               MeshNotes& notes);

}  // namespace lumel
