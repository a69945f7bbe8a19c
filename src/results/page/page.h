#pragma once
// A bake as one HTML page: the scene to walk through, its light in lux, and the bake's report.

#include <span>
#include <string>

#include "base/json/json_view.h"

namespace lumel {

/// Throws Error{input} if Lumel was built without three.js: pages are then unavailable.
void check_viewer();

/// Data of one bake for the page's viewer; has "lamps" only if the folder has lamps.json or
/// daylight.json, and "daylight" only if it has the latter. Throws Error{input} for files that
/// cannot be read.
Json page_data(const std::string& folder, const std::string& name);

/// Writes one self-contained HTML file. folders: one finished bake, or two to show side by side.
/// room: of room_data() for the first, or null.
/// Returns the file's size [bytes]. Throws Error{input} for a folder whose files cannot be read,
/// and if check_viewer() throws; Error{output} if the page cannot be written.
std::size_t write_page(const std::string& path, std::span<const std::string> folders,
                       const Json& room = {});

}  // namespace lumel
