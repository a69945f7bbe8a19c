// The options of lumel info.

#include <memory>

#include "method_options.h"
#include "shared_options.h"

namespace lumel {

Command info_command()
{
    const auto given = std::make_shared<InfoArguments>();
    const auto method = std::make_shared<GivenMethod>();
    BakeOptions& options = given->options;
    Command command{.name = "info",
                    .help = "List the contents of a scene and the memory that a bake needs"};
    command.add({scene_argument(given->scene)});
    add_light_options(command, options.lights);
    add_atlas_options(command, options.atlas);
    add_sides_option(command, options.atlas);
    add_methods(command, *method);
    add_directional_option(command, options.directional);
    add_preview_option(command, options.preview_width);
    add_memory_option(command, options.max_memory);
    add_json_flag(command, given->json);
    command.arguments = [given, method](const Command&) -> Arguments {
        given->options.solver.method = method->options();
        check_limits(given->options.solver);
        return {*given};
    };
    return command;
}

}  // namespace lumel
