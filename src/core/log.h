#pragma once
// Messages to the person at the terminal, on stderr.

#include <string_view>

namespace lumel {

/// A fact worth knowing. Hidden by set_quiet(true).
void log_info(std::string_view message);
/// Something the user may want to change. Shown also when quiet.
void log_warning(std::string_view message);
/// Hides log_info from now on.
void set_quiet(bool quiet);

}  // namespace lumel
