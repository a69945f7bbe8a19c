#pragma once
// WebP decoder.

#include <string>

#include "base/core/files.h"
#include "scene/values/scene.h"

namespace lumel {

/// True if the bytes begin as a WebP image.
bool is_webp(const Bytes& bytes);

/// Decodes a WebP image to 8-bit RGBA. `place` names it in messages. Throws Error{input} if it is
/// broken, truncated, animated, or claims far more pixels than its bytes plausibly encode.
Texture decode_webp(const Bytes& bytes, const std::string& place);

/// Version of the linked library: "1.2.4".
std::string webp_version();

}  // namespace lumel
