#pragma once
// scene.lumellinks: KeptLinks on the disk. See links_file.cpp.

#include <string>

#include "live/kept_links.h"

namespace lumel {

inline constexpr const char* kLinksFile = "scene.lumellinks";

/// Throws Error{output}.
void write_links(const std::string& path, KeptLinks kept);

/// Reads it whole. Throws Error{input} if it is missing, damaged, or of another version.
KeptLinks read_links(const std::string& path);

}  // namespace lumel
