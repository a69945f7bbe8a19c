#pragma once
// The libraries that unpack meshes.

#include <string>

namespace lumel {

/// Of the headers that it was built with: "1.5.5".
std::string draco_version();
std::string meshoptimizer_version();

}  // namespace lumel
