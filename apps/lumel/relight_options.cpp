// The options of lumel relight.

#include <memory>

#include "shared_options.h"

namespace lumel {

Command relight_command()
{
    const auto given = std::make_shared<RelightArguments>();
    Command command{
        .name = "relight",
        .help = "Relight a baked scene, with its lights dimmed, coloured, switched off or moved"};
    command.add(
        {bake_argument(given->folder,
                       "Folder that lumel bake wrote with --keep-links or --solver matrix"),
         {.names = "states",
          .type = "FILE",
          .help =
              "JSON: {\"states\": [{\"name\": \"evening\", \"others\": 0, \"lights\": "
              "{\"lamp\": 0.5, \"sky\": [0.2, 0.3, 0.6], \"spot\": {\"position\": [0, 2, 1]}}}]}",
          .target = &given->states,
          .required = true}});
    add_device_option(command, given->options.device);
    add_talk_options(command, given->talk);
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

}  // namespace lumel
