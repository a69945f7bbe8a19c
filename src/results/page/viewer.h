#pragma once
// The parts of a page that are the same in all of them. They are assembled into the program, see
// viewer.S.

#include <string_view>

namespace lumel {

/// page.html, in which /*style*/, /*bakes*/ and /*viewer*/ are to be replaced.
std::string_view page_frame();
std::string_view page_style();
/// The scripts of src/results/page/viewer with three.js, in one. Empty where three.js could not be
/// had.
std::string_view page_viewer();

}  // namespace lumel
