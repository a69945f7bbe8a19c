#pragma once
// Decoding of PNG, JPEG, WebP and Radiance HDR.

#include <string>

#include "base/core/image.h"
#include "scene/gltf/files.h"
#include "scene/values/scene.h"

namespace lumel {

/// Decodes a PNG, JPEG or WebP file to 8-bit RGBA. `place` names the image in messages. Throws
/// Error{input} if it is of another type, broken, truncated, or claims more than 16384 pixels a
/// side or more than its bytes can encode.
Texture decode_image(const Bytes& bytes, const std::string& place);

/// Decodes a Radiance image (.hdr, RGBE, top left first) to 3 channels of linear light, in the
/// file's unit. Throws Error{input} as decode_image does.
Image decode_hdr(const Bytes& bytes, const std::string& place);

}  // namespace lumel
