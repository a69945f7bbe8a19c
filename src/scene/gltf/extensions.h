#pragma once
// Supported glTF extensions.

#include "base/json/json_view.h"

namespace lumel {

/// Throws Error{input} with the first required extension that is not supported.
void check_extensions(const JsonView& root);

/// Throws Error{input} for an unsupported extension at this location.
[[noreturn]] void refuse_extension(const JsonView& place, const std::string& name);

/// Removes an extension from an object of the document, if present.
void erase_extension(Json& object, const char* name);

/// Removes the name from extensionsUsed and extensionsRequired of a document.
void forget_extension(Json& gltf, const char* name);

/// True if extensionsUsed names it.
bool uses_extension(const JsonView& root, const char* name);

}  // namespace lumel
