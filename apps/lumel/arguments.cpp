// The command line as a whole: all commands, and the values given to one of them.

#include "arguments.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "command.h"
#include "manual.h"
#include "parser.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr const char* kVersion = "lumel " LUMEL_VERSION "\n";

const Option kHelp{
    .names = "-h,--help", .help = "Print this help message and exit", .target = HelpFlag{}};

constexpr std::string_view kEveryday[] = {"bake",    "view", "render", "report",
                                          "measure", "info", "help"};

void add_commands(Command& program)
{
    program.commands = {bake_command(),
                        update_command(),
                        relight_command(),
                        why_command(),
                        measure_command(),
                        probes_command(),
                        render_command(),
                        play_command(),
                        view_command(),
                        reference_command(),
                        info_command(),
                        compare_command(),
                        report_command(),
                        devices_command(),
                        methods_command(),
                        help_command(program),
                        completion_command(program),
                        man_command(program),
                        options_command(program)};
    for (Command& command : program.commands) {
        command.everyday = std::ranges::find(kEveryday, command.name) != std::end(kEveryday);
        command.options.insert(command.options.begin(), kHelp);
        command.options.front().group = kProgramGroup;
    }
}

}  // namespace

Arguments parse_arguments(int count, char** values)
{
    Command program{.name = "lumel",
                    .help = "Lumel bakes the light of a glTF scene into lightmaps."};
    program.add("Options", {kHelp,
                            {"-V,--version", "", "Display program version information and exit",
                             VersionFlag{}}});
    add_commands(program);

    const Parsed parsed = parse(program, count, values);
    const Command& command = *parsed.command;
    if (parsed.wish == Parsed::Wish::version)
        return {TextArguments{kVersion}};
    if (parsed.wish == Parsed::Wish::help)
        return {TextArguments{help_text(program, command)}};
    return command.arguments(command);
}

}  // namespace lumel
