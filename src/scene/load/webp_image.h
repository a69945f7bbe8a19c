#pragma once
// Decoding of WebP.

#include <string>

#include "base/core/files.h"
#include "scene/values/scene.h"

namespace lumel {

/// True if the bytes start like a WebP picture.
bool is_webp(const Bytes& bytes);

/// Decodes a WebP picture to 8-bit RGBA. `place` names it in messages. Throws Error{input} if it is
/// broken, cut short, animated, or claims far more pixels than its bytes can be expected to hold.
Texture decode_webp(const Bytes& bytes, const std::string& place);

/// Of the library that is linked: "1.2.4".
std::string webp_version();

}  // namespace lumel
