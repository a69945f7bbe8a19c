#pragma once
// WebP pictures, and EXT_texture_webp, by which textures name them.

#include <string>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace lumel {

/// True if the bytes start like a WebP picture.
bool is_webp(const Bytes& bytes);

/// Decodes a WebP picture to 8-bit RGBA. `place` names it in messages. Throws Error{input} if it is
/// broken, cut short, animated, or claims far more pixels than its bytes can be expected to hold.
Texture decode_webp(const Bytes& bytes, const std::string& place);

/// Textures name their WebP picture as any other, unless they have another; the extension is gone
/// from the document. Throws Error{input}.
void name_webp_images(GltfDocument& document);

}  // namespace lumel
