#pragma once
// The command line described for its users: the texts of --help, and the page docs/options.md.
// Both are printed from the options as CLI11 holds them, so that neither can differ from the other.

#include <string>

namespace CLI {
class App;
}

namespace lumel {

/// The text of --help for the program or for one of its commands, `path` as typed.
std::string help_text(const CLI::App& app, const std::string& path);

/// docs/options.md: all commands and options of the program as Markdown.
std::string options_page(const CLI::App& program);

}  // namespace lumel
