#pragma once
// Which glTF extensions Lumel understands.

#include "base/json/json_view.h"

namespace lumel {

/// Throws Error{input} naming the first extension that the file requires and Lumel cannot honour.
void check_extensions(const JsonView& root);

/// Refuses an extension that the file needs at this place.
[[noreturn]] void refuse_extension(const JsonView& place, const std::string& name);

/// Takes an extension out of an object of the document, if it is there.
void erase_extension(Json& object, const char* name);

/// Takes its name out of extensionsUsed and extensionsRequired of a document: nothing has it now.
void forget_extension(Json& gltf, const char* name);

/// True if extensionsUsed names it.
bool uses_extension(const JsonView& root, const char* name);

}  // namespace lumel
