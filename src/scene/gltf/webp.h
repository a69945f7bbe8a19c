#pragma once
// EXT_texture_webp, by which textures name WebP pictures.

#include "scene/gltf/document.h"

namespace lumel {

/// Textures name their WebP picture as any other, unless they have another; the extension is gone
/// from the document. Throws Error{input}.
void name_webp_images(GltfDocument& document);

}  // namespace lumel
