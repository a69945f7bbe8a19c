#pragma once
// Commands and options as data. The parser, --help, docs/options.md, the manual page and shell
// completion all read the same tables.

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

namespace lumel {

struct Arguments;

/// Target of an option that prints the help of its command.
struct HelpFlag {};
/// Target of an option that prints the version.
struct VersionFlag {};

/// Target of an option: a variable, or a function called once per value. Options that set a bool,
/// call a function without parameters or print (HelpFlag, VersionFlag) take no value.
using Target =
    std::variant<HelpFlag, VersionFlag, bool*, int*, std::uint32_t*, std::uint64_t*, float*,
                 double*, std::string*, std::vector<std::string>*, std::function<void()>,
                 std::function<void(double)>, std::function<void(const std::string&)>,
                 std::function<void(std::array<double, 2>)>>;

/// Returns an empty string for a valid value, else the reason why it is not.
using Check = std::function<std::string(const std::string& value)>;

/// An option or an argument of a command: {names, type, help, target, default_value, check}.
struct Option {
    std::string names;  ///< "-q,--quiet"; the name of an argument has no dash
    std::string type;   ///< name of the value: "N", "FILE|R,G,B", "area|centre"
    std::string help;
    Target target;
    std::string default_value;  ///< as --help prints it
    Check check;
    bool required = false;
    bool repeatable = false;
    std::string needs;      ///< name of an option that must also be given
    std::string excludes;   ///< name of an option that must not also be given
    std::string group;      ///< title above it in --help and docs/options.md; set by Command::add()
    std::size_t count = 0;  ///< occurrences on the command line; set by parse()

    bool is_argument() const { return !names.starts_with('-'); }
};

/// A command, or the program, which has commands.
struct Command {
    std::string name;
    std::string help;
    std::vector<Option> options;
    /// Returns the values once parse() has stored them. Throws Error{input} if they do not fit
    /// together.
    std::function<Arguments(const Command& command)> arguments;
    std::string footer;  ///< printed below --help; a tab separates columns
    bool listed = true;  ///< in --help and in docs/options.md
    std::vector<Command> commands;
    bool everyday = false;  ///< above the other commands in --help of the program
    /// Names of the options above all others in its --help, in this order.
    std::vector<std::string> everyday_options;

    /// Adds options below a title; arguments have none.
    void add(const std::string& group, std::initializer_list<Option> added);
    void add(std::initializer_list<Option> added) { add("", added); }

    /// True if the option was given on the command line. option_name: "--size".
    bool given(const std::string& option_name) const;
};

/// "-q" and "--quiet".
std::vector<std::string> names_of(const Option& option);

// The commands, each in a file of its own, NAME_options.cpp.

Command bake_command();
Command update_command();
Command relight_command();
Command why_command();
Command measure_command();
Command probes_command();
Command render_command();
Command play_command();
Command view_command();
Command reference_command();
Command info_command();
Command compare_command();
Command report_command();
Command devices_command();
Command methods_command();

// Commands that describe the program, which must outlive them.

Command help_command(const Command& program);
Command man_command(const Command& program);
Command completion_command(const Command& program);
Command options_command(const Command& program);

}  // namespace lumel
