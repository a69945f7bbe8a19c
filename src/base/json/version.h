#pragma once
// Version of the library that reads and writes JSON, and so glTF.

#include <string>

namespace lumel {

/// "3.11.2"
std::string json_library_version();

}  // namespace lumel
