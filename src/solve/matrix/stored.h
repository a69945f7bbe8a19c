#pragma once
// Compressed matrices as bytes, for files.

#include <string>

#include "solve/matrix/compressed.h"

namespace lumel {

/// Message for an inconsistent file.
inline constexpr const char* kMatrixDamage = "is damaged; bake the scene again";

/// About bytes_of(matrix) of them.
std::string to_bytes(const CompressedMatrix& matrix);

/// Inverse of to_bytes. Every index in the result is within its bounds. Throws Error{input}, which
/// names the file `where`, if the bytes are no such matrix, or not all of one.
CompressedMatrix from_bytes(const std::string& bytes, const std::string& where);

}  // namespace lumel
