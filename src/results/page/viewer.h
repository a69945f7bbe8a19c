#pragma once
// Common parts of all pages, assembled into the program by viewer.S.

#include <string_view>

namespace lumel {

/// page.html, with /*style*/, /*bakes*/ and /*viewer*/ to replace.
std::string_view page_frame();
std::string_view page_style();
/// The scripts of src/results/page/viewer bundled with three.js; empty if built without three.js.
std::string_view page_viewer();

}  // namespace lumel
