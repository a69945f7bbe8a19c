#pragma once
// The manual page of the program.

#include <string>

#include "command.h"

namespace lumel {

/// lumel(1) in the form of man(7), printed from the tables of options.
std::string man_page(const Command& program);

}  // namespace lumel
