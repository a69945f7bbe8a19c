// The options of lumel update.

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "command.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {

Command update_command(CLI::App& program)
{
    const auto given = std::make_shared<UpdateArguments>();
    UpdateArguments& update = *given;
    CLI::App& command = *program.add_subcommand(
        "update", "Correct the lightmaps of a bake where its scene was edited");
    UpdateOptions& options = update.options;
    command.add_option("folder", update.folder, "What lumel bake wrote, corrected in place")
        ->required()
        ->type_name("FOLDER");
    command.add_option("scene", update.scene, "The edited scene, a .gltf or .glb file")
        ->required()
        ->type_name("FILE");
    command
        .add_option_function<double>(
            "--residual", [&options](double percent) { options.residual = percent / 100.0; },
            "Stop at this error of the correction, as a part of all light")
        ->type_name("PERCENT")
        ->group(kStopGroup)
        ->default_str(fmt::format("{:g}", 100.0 * options.residual))
        ->check(positive());
    add_light_options(command, options.lights);
    add_device_option(command, options.device);
    add_preview_option(command, options.preview_width);
    add_talk_options(command, update.talk);
    return {&command, [given]() -> Arguments { return *given; }};
}

}  // namespace lumel
