// The options of the commands by which the program describes itself: help, man, completion,
// options.

#include <memory>

#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "command.h"
#include "completion.h"
#include "listing.h"
#include "man_page.h"
#include "manual.h"
#include "option_values.h"
#include "suggestion.h"

namespace lumel {
namespace {

const Choices<Shell> kShells = {{"bash", Shell::bash}, {"zsh", Shell::zsh}};

/// The text of --help for a command by its name, or for the program.
std::string help_of(const CLI::App& program, const std::string& name)
{
    if (name.empty())
        return help_text(program, program.get_name());
    for (const CLI::App* command : commands_of(program))
        if (command->get_name() == name)
            return help_text(*command, program.get_name() + " " + name);
    throw Error(ErrorKind::input, "", unknown_command(program, name));
}

}  // namespace

Command help_command(CLI::App& program)
{
    const auto name = std::make_shared<std::string>();
    CLI::App& command =
        *program.add_subcommand("help", "Describe the program, or one of its commands");
    command.add_option("command", *name, "The command")->type_name(kCommandType);
    return {&command,
            [&program, name]() -> Arguments { return TextArguments{help_of(program, *name)}; }};
}

Command man_command(CLI::App& program)
{
    return {program.add_subcommand("man", "Print the manual page; lumel man | man -l - shows it"),
            [&program]() -> Arguments { return TextArguments{man_page(program)}; }};
}

Command completion_command(CLI::App& program)
{
    const auto shell = std::make_shared<Shell>(Shell::bash);
    CLI::App& command = *program.add_subcommand(
        "completion", "Print what completes commands and options in a shell");
    add_choice(command, "shell", *shell, kShells, "bash or zsh; source <(lumel completion bash)")
        ->default_str("")
        ->required();
    return {&command, [&program, shell]() -> Arguments {
                return TextArguments{completion_script(program, *shell)};
            }};
}

Command options_command(CLI::App& program)
{
    // No group, so that nothing lists it: it is for those who change the options.
    return {program.add_subcommand("options", "Print docs/options.md")->group(""),
            [&program]() -> Arguments { return TextArguments{options_page(program)}; }};
}

}  // namespace lumel
