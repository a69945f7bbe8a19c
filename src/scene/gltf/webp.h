#pragma once
// EXT_texture_webp: WebP images of textures.

#include "scene/gltf/document.h"

namespace lumel {

/// Makes the WebP image the source of textures that have no other, and removes the extension from
/// the document. Throws Error{input}.
void name_webp_images(GltfDocument& document);

}  // namespace lumel
