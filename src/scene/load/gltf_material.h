#pragma once
// Materials of a glTF file.

#include <vector>

#include "scene/gltf/document.h"
#include "scene/values/scene.h"

namespace lumel {

/// All materials of the file, and the images that those in use need.
struct MaterialList {
    std::vector<Material> materials;
    std::vector<std::size_t> images;        ///< index in the file, by index into Scene::textures
    std::size_t transmission_textures = 0;  ///< not read, of materials in use
    std::size_t missing_textures = 0;       ///< textures in use that have no image
    bool clamped = false;                   ///< a base colour left 0…1
};

/// `used[i]`: whether material i is on a surface; only then its images are read.
/// Throws Error{input}.
MaterialList read_materials(const GltfDocument& document, const std::vector<bool>& used,
                            MaterialModel model);

/// Decodes the images in parallel. Throws Error{input} for the first in order that fails.
std::vector<Texture> read_textures(const GltfDocument& document,
                                   const std::vector<std::size_t>& images);

}  // namespace lumel
