// The options of lumel relight.

#include <memory>

#include <CLI/CLI.hpp>

#include "command.h"
#include "shared_options.h"

namespace lumel {

Command relight_command(CLI::App& program)
{
    const auto given = std::make_shared<RelightArguments>();
    RelightArguments& relight = *given;
    CLI::App& command = *program.add_subcommand(
        "relight",
        "Light a bake of --keep-links or --solver matrix anew, with its lights dimmed, coloured, "
        "switched off or moved");
    command
        .add_option("folder", relight.folder,
                    "What lumel bake wrote with --keep-links or --solver matrix")
        ->required()
        ->type_name("FOLDER");
    command
        .add_option(
            "states", relight.states,
            "JSON: {\"states\": [{\"name\": \"evening\", \"others\": 0, \"lights\": "
            "{\"lamp\": 0.5, \"sky\": [0.2, 0.3, 0.6], \"spot\": {\"position\": [0, 2, 1]}}}]}")
        ->required()
        ->type_name("FILE");
    add_device_option(command, relight.options.device);
    add_talk_options(command, relight.talk);
    return {&command, [given]() -> Arguments { return *given; }};
}

}  // namespace lumel
