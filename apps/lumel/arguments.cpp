// The command line as a whole: all commands, and what becomes of a line that is none of them.

#include "arguments.h"

#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "base/core/error.h"
#include "command.h"
#include "manual.h"
#include "shared_options.h"
#include "suggestion.h"

namespace lumel {
namespace {

/// What the parser did not accept, as one sentence.
std::string complaint(const CLI::App& program, const CLI::ParseError& error)
{
    const auto given = program.get_subcommands();
    const CLI::App& command = given.empty() ? program : *given.front();
    const std::string path =
        given.empty() ? program.get_name() : program.get_name() + " " + command.get_name();
    const std::vector<std::string> extras = program.remaining(true);
    for (const std::string& word : extras)
        if (word.starts_with('-'))
            return unknown_option(command, path, word);
    if (!extras.empty() && given.empty())
        return unknown_command(program, extras.front());
    if (extras.empty() && given.empty() && error.get_name() == "RequiredError")
        return "a command is needed; lumel --help lists what there is";
    const std::string advice = "; " + path + " --help lists what there is";
    return extras.empty() ? error.what() + advice
                          : fmt::format("{} was not expected{}", extras.front(), advice);
}

std::vector<Command> add_commands(CLI::App& program)
{
    return {bake_command(program),      update_command(program),     relight_command(program),
            why_command(program),       measure_command(program),    probes_command(program),
            render_command(program),    play_command(program),       view_command(program),
            reference_command(program), info_command(program),       compare_command(program),
            report_command(program),    devices_command(program),    methods_command(program),
            help_command(program),      completion_command(program), man_command(program),
            options_command(program)};
}

}  // namespace

Arguments parse_arguments(int count, char** values)
{
    CLI::App program("Lumel bakes the light of a glTF scene into lightmaps.", "lumel");
    program.set_version_flag("-V,--version", "lumel " LUMEL_VERSION);
    program.require_subcommand(1);
    program.formatter_fn([](const CLI::App* command, const std::string& path, CLI::AppFormatMode) {
        return help_text(*command, path);
    });
    const std::vector<Command> commands = add_commands(program);
    for (const Command& command : commands)
        command.parser->get_help_ptr()->group(kProgramGroup);

    try {
        program.parse(count, values);
    } catch (const CLI::CallForHelp&) {
        return TextArguments{program.help()};
    } catch (const CLI::CallForVersion& version) {
        return TextArguments{std::string(version.what()) + "\n"};
    } catch (const CLI::ParseError& error) {
        throw Error(ErrorKind::input, "", complaint(program, error));
    }
    for (const Command& command : commands)
        if (command.parser->parsed())
            return command.arguments();
    return TextArguments{program.help()};
}

}  // namespace lumel
