#pragma once
// Checks of the sizes in the header of an EXR file, before memory is allocated for them.

#include <string>

#include "base/core/files.h"

namespace lumel {

/// Throws Error{input} if a header is truncated, or claims more attributes, texels, tiles or chunks
/// than the file can hold or Lumel supports. `path` names the file.
void check_exr_claims(const Bytes& bytes, const std::string& path);

}  // namespace lumel
