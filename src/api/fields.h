#pragma once
// Names of settings in messages.

#include <string>
#include <vector>

namespace lumel::v0 {

/// The message with fields of lumel.h in place of options of the command line:
/// "AtlasSettings::size" for "--size".
std::string in_fields(const std::string& message);
std::vector<std::string> in_fields(const std::vector<std::string>& messages);

}  // namespace lumel::v0
