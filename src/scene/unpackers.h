#pragma once
// The libraries that unpack files.

#include <string>

namespace lumel {

/// Of the headers that it was built with: "1.5.5".
std::string draco_version();
std::string meshoptimizer_version();

/// Of the library that is linked: "1.2.4".
std::string webp_version();

}  // namespace lumel
