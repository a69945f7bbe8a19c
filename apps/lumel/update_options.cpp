// The options of lumel update.

#include <memory>

#include "option_values.h"
#include "shared_options.h"

namespace lumel {

Command update_command()
{
    const auto given = std::make_shared<UpdateArguments>();
    UpdateOptions& options = given->options;
    Command command{.name = "update",
                    .help = "Correct the lightmaps of a bake where its scene was edited"};
    command.add({bake_argument(given->folder, "What lumel bake wrote, corrected in place"),
                 {.names = "scene",
                  .type = "FILE",
                  .help = "The edited scene, a .gltf or .glb file",
                  .target = &given->scene,
                  .required = true}});
    command.add(kStopGroup, {{"--residual", "PERCENT",
                              "Stop at this error of the correction, as a part of all light",
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
