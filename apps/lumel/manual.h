#pragma once
// The command line described for its users: the texts of --help, and the page docs/options.md.

#include <string>

#include "command.h"

namespace lumel {

/// The text of --help for the program or for one of its commands.
std::string help_text(const Command& program, const Command& command);

/// docs/options.md: all commands and options of the program as Markdown.
std::string options_page(const Command& program);

}  // namespace lumel
