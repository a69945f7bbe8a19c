#pragma once
// Vertex attributes of a primitive, checked and converted to floats.

#include "scene/gltf/document.h"
#include "scene/load/gltf_mesh.h"
#include "scene/values/scene.h"

namespace lumel {

/// Fills positions, normals, texcoords and colors of `primitive` from the JSON primitive `view`.
/// `weights`: default weights of the mesh's morph targets. Normals are not normalised. Throws
/// Error{input} for a missing POSITION, wrong types, different lengths, NaN or infinity.
void read_attributes(const GltfDocument& document, const JsonView& view,
                     const std::vector<float>& weights, Primitive& primitive);

}  // namespace lumel
