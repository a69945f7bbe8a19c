#pragma once
// A bake as one HTML page: the scene to walk through, its light in lux, and the bake's report.

#include <span>
#include <string>

namespace lumel {

/// Throws Error{input} if Lumel was built without three.js: pages are then unavailable.
void check_viewer();

/// Writes one self-contained HTML file. folders: one finished bake, or two to show side by side.
/// Returns the file's size [bytes]. Throws Error{input} for a folder whose files cannot be read,
/// and if check_viewer() throws; Error{output} if the page cannot be written.
std::size_t write_page(const std::string& path, std::span<const std::string> folders);

}  // namespace lumel
