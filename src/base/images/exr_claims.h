#pragma once
// What the header of an EXR file says of its size, before anybody takes memory for it.

#include <string>

#include "base/core/files.h"

namespace lumel {

/// Throws Error{input} if a header is cut short, or claims more than the bytes of the file can hold
/// or than is ever read: attributes, texels, tiles, chunks. `path` names the file.
void check_exr_claims(const Bytes& bytes, const std::string& path);

}  // namespace lumel
