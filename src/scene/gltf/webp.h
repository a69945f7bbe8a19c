#pragma once
// EXT_texture_webp: WebP images of textures.

#include "scene/gltf/document.h"

namespace lumel {

/// Makes the WebP image the source of textures that have no other, without the extension. Throws
/// Error{input}.
void name_webp_images(GltfDocument& document);

/// The reverse, for a file to be written: `is_webp` tells which images, by index. Textures that
/// have no other source require the extension.
void require_webp_images(Json& gltf, const std::vector<bool>& is_webp);

}  // namespace lumel
