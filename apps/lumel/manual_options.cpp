// The options of the commands by which the program describes itself: help, man, completion,
// options.

#include <memory>

#include "arguments.h"
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
std::string help_of(const Command& program, const std::string& name)
{
    if (name.empty())
        return help_text(program, program);
    for (const Command* command : commands_of(program))
        if (command->name == name)
            return help_text(program, *command);
    throw Error(ErrorKind::input, "", unknown_command(program, name));
}

}  // namespace

Command help_command(const Command& program)
{
    const auto name = std::make_shared<std::string>();
    Command command{.name = "help", .help = "Describe the program, or one of its commands"};
    command.add({{"command", kCommandType, "The command", name.get()}});
    command.arguments = [&program, name](const Command&) -> Arguments {
        return {TextArguments{help_of(program, *name)}};
    };
    return command;
}

Command man_command(const Command& program)
{
    return {.name = "man",
            .help = "Print the manual page; lumel man | man -l - shows it",
            .arguments = [&program](const Command&) -> Arguments {
                return {TextArguments{man_page(program)}};
            }};
}

Command completion_command(const Command& program)
{
    const auto shell = std::make_shared<Shell>(Shell::bash);
    Command command{.name = "completion",
                    .help = "Print what completes commands and options in a shell"};
    command.add({choice(*shell, kShells,
                        {.names = "shell",
                         .help = "bash or zsh; source <(lumel completion bash)",
                         .required = true})});
    command.arguments = [&program, shell](const Command&) -> Arguments {
        return {TextArguments{completion_script(program, *shell)}};
    };
    return command;
}

Command options_command(const Command& program)
{
    return {.name = "options",
            .help = "Print docs/options.md",
            .arguments = [&program](const Command&) -> Arguments {
                return {TextArguments{options_page(program)}};
            },
            .listed = false};  // for those who change the options
}

}  // namespace lumel
