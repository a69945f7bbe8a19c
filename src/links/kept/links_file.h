#pragma once
// scene.lumellinks: StoredLinks on disk. See links_file.cpp.

#include <string>

#include "links/kept/stored_links.h"

namespace lumel {

inline constexpr const char* kLinksFile = "scene.lumellinks";

/// Throws Error{output}.
void write_links(const std::string& path, StoredLinks kept);

/// Reads the whole file. Throws Error{input} if it is missing, damaged, or of another version.
StoredLinks read_links(const std::string& path);

}  // namespace lumel
