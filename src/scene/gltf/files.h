#pragma once
// Bytes behind URIs, never from outside the scene's folder.

#include <string>

#include "base/core/files.h"
#include "base/json/json_view.h"

namespace lumel {

/// What a glTF "uri" stands for: a data: URI, or a file (percent-encoded, relative) that lies
/// in the folder of `scene_path` or below it once symbolic links are resolved.
/// Throws Error{input} for all else.
Bytes read_uri(const JsonView& uri, const std::string& scene_path);

}  // namespace lumel
