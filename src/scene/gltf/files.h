#pragma once
// Reads the data of URIs, only from the scene's folder.

#include <string>

#include "base/core/files.h"
#include "base/json/json_view.h"

namespace lumel {

/// Contents of a glTF "uri": a data: URI, or a percent-encoded relative path to a file inside the
/// folder of `scene_path` after symbolic links are resolved. Throws Error{input} for all others.
Bytes read_uri(const JsonView& uri, const std::string& scene_path);

}  // namespace lumel
