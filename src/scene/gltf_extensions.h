#pragma once
// Which glTF extensions Lumel understands.

#include "scene/gltf_json.h"

namespace lumel {

/// Throws Error{input} naming the first extension that the file requires and Lumel cannot honour.
void check_required_extensions(const JsonView& root);

/// Refuses an extension that the file needs at this place.
[[noreturn]] void refuse_extension(const JsonView& place, const char* name);

/// True if extensionsUsed names it.
bool uses_extension(const JsonView& root, const char* name);

}  // namespace lumel
