#pragma once
// A bake as one page that a browser shows: the scene to walk through, its light in lux, what the
// bake took.

#include <span>
#include <string>

namespace lumel {

/// Throws Error{input} if this Lumel was built where three.js could not be had: then there are no
/// pages.
void check_viewer();

/// Writes one HTML file that needs no other file and no network. folders: one finished bake or two,
/// to be shown side by side. Returns the size of the file [bytes]. Throws Error{input} for a folder
/// whose files cannot be read, and what check_viewer() throws; Error{output} if the page cannot be
/// written.
std::size_t write_page(const std::string& path, std::span<const std::string> folders);

}  // namespace lumel
