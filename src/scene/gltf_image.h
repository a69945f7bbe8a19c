#pragma once
// Decoding of PNG and JPEG.

#include <string>

#include "scene/gltf_files.h"
#include "scene/scene.h"

namespace lumel {

/// Decodes a PNG or JPEG file to 8-bit RGBA. `place` names the image in messages.
/// Throws Error{input} if it is neither, broken, cut short, or claims more pixels than
/// 16384 a side or than its bytes can encode.
Texture decode_image(const Bytes& bytes, const std::string& place);

}  // namespace lumel
