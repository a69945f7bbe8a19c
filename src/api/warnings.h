#pragma once
// Messages for the user.

#include <string>
#include <vector>

namespace lumel::v0 {

/// The messages with names of fields, see in_fields(); passes those that are not in `known` on to
/// the function of on_warning().
std::vector<std::string> told(const std::vector<std::string>& messages,
                              const std::vector<std::string>& known = {});

}  // namespace lumel::v0
