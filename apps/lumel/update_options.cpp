// The options of lumel update.

#include <memory>

#include "option_values.h"
#include "shared_options.h"

namespace lumel {

Command update_command()
{
    const auto given = std::make_shared<UpdateArguments>();
    UpdateOptions& options = given->options;
    Command command{.name = "update", .help = "Update a bake after its scene was edited"};
    command.add(
        {bake_argument(given->folder, "Folder that lumel bake wrote; it is updated in place"),
         {.names = "scene",
          .type = "FILE",
          .help = "Edited scene, a .gltf or .glb file",
          .target = &given->scene,
          .required = true}});
    command.add(kStopGroup, {{"--residual", "PERCENT",
                              "Stop at this error of the correction, relative to all light",
                              [&options](double percent) { options.residual = percent / 100.0; },
                              text_of(100.0 * options.residual), positive()}});
    add_light_options(command, options.lights);
    add_device_option(command, options.device);
    add_preview_option(command, options.preview_width);
    add_talk_options(command, given->talk);
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

}  // namespace lumel
