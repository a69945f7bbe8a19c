#pragma once
// Scripts that complete commands and options in a shell, printed from the tables of options.

#include <string>

#include "command.h"

namespace lumel {

enum class Shell { bash, zsh };

/// A script that the shell sources, or finds in its folder of completions.
std::string completion_script(const Command& program, Shell shell);

}  // namespace lumel
