#pragma once
// Bytes from disk and from URIs, never from outside the scene's folder.

#include <cstdint>
#include <string>
#include <vector>

#include "scene/gltf_json.h"

namespace lumel {

using Bytes = std::vector<std::uint8_t>;

/// The whole of a regular file. `place` names it in messages. Throws Error{input} if it is
/// missing, a directory, not a regular file, empty, larger than 8 GiB or unreadable.
Bytes read_file(const std::string& path, const std::string& place);

/// What a glTF "uri" stands for: a data: URI, or a file (percent-encoded, relative) that lies
/// in the folder of `scene_path` or below it once symbolic links are resolved.
/// Throws Error{input} for all else.
Bytes read_uri(const JsonView& uri, const std::string& scene_path);

}  // namespace lumel
