#pragma once
// Materials of a glTF file.

#include <vector>

#include "scene/gltf/document.h"
#include "scene/values/scene.h"

namespace lumel {

/// All materials of the file, and the images that used materials need.
struct MaterialList {
    std::vector<Material> materials;
    std::vector<std::size_t> images;        ///< [Scene::textures] index in the file
    std::size_t transmission_textures = 0;  ///< ignored ones of used materials
    std::size_t missing_textures = 0;       ///< used textures without an image
    bool clamped = false;                   ///< a base colour was outside 0…1
};

/// `used[i]`: true if a surface has material i; only then are its images read. Throws Error{input}.
MaterialList read_materials(const GltfDocument& document, const std::vector<bool>& used,
                            MaterialModel model);

/// Decodes the images in parallel. Throws Error{input} for the first failure in order.
std::vector<Texture> read_textures(const GltfDocument& document,
                                   const std::vector<std::size_t>& images);

}  // namespace lumel
