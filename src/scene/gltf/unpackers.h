#pragma once
// Versions of the mesh decompression libraries.

#include <string>

namespace lumel {

/// Compile-time version: "1.5.5".
std::string draco_version();
std::string meshoptimizer_version();

}  // namespace lumel
