#pragma once
// Compressed matrices as bytes, for files.

#include <cstddef>
#include <span>
#include <vector>

#include "solve/matrix/compressed.h"

namespace lumel {

/// About bytes_of(matrix) of them.
std::vector<std::byte> to_bytes(const CompressedMatrix& matrix);

/// What to_bytes made them of. Every index in the result is within its bounds. Throws Error{input}
/// if the bytes are no such matrix, or not all of one.
CompressedMatrix from_bytes(std::span<const std::byte> bytes);

}  // namespace lumel
