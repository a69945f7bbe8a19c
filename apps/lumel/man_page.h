#pragma once
// The manual page of the program.

#include <string>

namespace CLI {
class App;
}

namespace lumel {

/// lumel(1) in the form of man(7), printed from the options as CLI11 holds them.
std::string man_page(const CLI::App& program);

}  // namespace lumel
