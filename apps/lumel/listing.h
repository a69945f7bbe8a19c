#pragma once
// Commands and options as --help, docs/options.md, the manual page and shell completion list them.

#include <string>
#include <vector>

#include "command.h"

namespace lumel {

/// The type of an argument that is the name of a command.
inline constexpr const char* kCommandType = "COMMAND";

/// The commands of the program that are listed.
std::vector<const Command*> commands_of(const Command& program);

/// The arguments of a command, or its options.
std::vector<const Option*> arguments_of(const Command& command);
std::vector<const Option*> options_of(const Command& command);

/// "lumel bake", or "lumel" for the program itself.
std::string path_of(const Command& program, const Command& command);

/// "-q, --quiet" or "--size N"; for arguments without a dash their name in capitals.
std::string spelling(const Option& option);

/// "lumel bake SCENE FOLDER [OPTIONS]"
std::string usage(const Command& program, const Command& command);

/// An option of one or more commands.
struct OptionRow {
    std::string name;  ///< as of spelling()
    std::vector<std::string> commands;
    std::string default_value;
    std::string meaning;
};

struct OptionSection {
    std::string title;
    std::vector<OptionRow> rows;
};

/// All options of all commands; the same option of several commands makes one row.
std::vector<OptionSection> sections_of(const Command& program);

/// "bake, update", or "all" if these are all commands of the program.
std::string commands_text(const OptionRow& row, const Command& program);

}  // namespace lumel
