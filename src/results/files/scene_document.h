#pragma once
// Scenes that no file contains, as glTF.

#include "scene/gltf/document.h"
#include "scene/values/scene.h"

namespace lumel {

/// A scene as the reader of a file would see it.
struct SceneDocument {
    GltfDocument document;
    /// Its instances and primitives, with their numbers in the document; without vertices and
    /// textures.
    Scene scene;
};

/// Meshes in use, materials, textures and lights of a scene that was made in memory; without its
/// sky. Node i is instance i.
SceneDocument document_of(const Scene& scene);

}  // namespace lumel
