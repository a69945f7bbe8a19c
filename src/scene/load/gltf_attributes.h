#pragma once
// Vertex attributes of one primitive, checked and as floats.

#include "scene/gltf/document.h"
#include "scene/load/gltf_mesh.h"
#include "scene/values/scene.h"

namespace lumel {

/// Fills positions, normals, texcoords and colors of `primitive` from the JSON primitive `view`.
/// `weights`: default weights of the mesh's morph targets. Normals are as in the file.
/// Throws Error{input}: missing POSITION, wrong types, lengths that differ, NaN or infinity.
void read_attributes(const GltfDocument& document, const JsonView& view,
                     const std::vector<float>& weights, Primitive& primitive);

}  // namespace lumel
