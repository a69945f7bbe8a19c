#pragma once
// Commands and options of the program as the parser holds them: the one table behind --help,
// docs/options.md, the manual page and the completion of shells.

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lumel {

/// The type of an argument that is the name of a command.
inline constexpr const char* kCommandType = "COMMAND";

/// Its commands that are listed.
std::vector<const CLI::App*> commands_of(const CLI::App& program);

/// Its arguments (`positional`) or its options that are listed.
std::vector<const CLI::Option*> options_of(const CLI::App& app, bool positional);

/// "-q" and "--quiet".
std::vector<std::string> names_of(const CLI::Option& option);

/// What its value is called: "N", "FILE|R,G,B", "area|centre"; empty if it takes none.
std::string type_of(const CLI::Option& option);

/// "-q, --quiet" or "--size N"; for arguments without a dash their name in capitals.
std::string spelling(const CLI::Option& option);

/// "lumel bake SCENE FOLDER [OPTIONS]"; `path` as typed.
std::string usage(const CLI::App& app, const std::string& path);

/// An option of one or more commands.
struct OptionRow {
    std::string name;  ///< as of spelling()
    std::vector<std::string> commands;
    std::string value;  ///< its default
    std::string meaning;
};

struct OptionSection {
    std::string title;
    std::vector<OptionRow> rows;
};

/// All options of all commands; the same option of several commands makes one row.
std::vector<OptionSection> sections_of(const CLI::App& program);

/// "bake, update", or "all" if these are all commands of the program.
std::string commands_text(const OptionRow& row, const CLI::App& program);

}  // namespace lumel
