#pragma once
// What completes commands and options in a shell, printed from the options as CLI11 holds them.

#include <string>

namespace CLI {
class App;
}

namespace lumel {

enum class Shell { bash, zsh };

/// A script that the shell sources, or finds in its folder of completions.
std::string completion_script(const CLI::App& program, Shell shell);

}  // namespace lumel
