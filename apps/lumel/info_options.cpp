// The options of lumel info.

#include <memory>

#include <CLI/CLI.hpp>

#include "command.h"
#include "method_options.h"
#include "shared_options.h"

namespace lumel {

Command info_command(CLI::App& program)
{
    const auto given = std::make_shared<InfoArguments>();
    InfoArguments& info = *given;
    const auto method = std::make_shared<GivenMethod>();
    CLI::App& command =
        *program.add_subcommand("info", "List what is in a scene and what a bake of it would need");
    command.add_option("scene", info.scene, "A .gltf or .glb file")->required()->type_name("FILE");
    add_light_options(command, info.options.lights);
    add_atlas_options(command, info.options.atlas);
    add_sides_option(command, info.options.atlas);
    command.option_defaults()->group(kMethodGroup);
    add_methods(command, *method);
    add_directional_option(command, info.options.directional);
    add_preview_option(command, info.options.preview_width);
    add_memory_option(command, info.options.max_memory);
    add_json_flag(command, info.json);
    return {&command, [given, method]() -> Arguments {
                given->options.solver.method = method->options();
                check_limits(given->options.solver);
                return *given;
            }};
}

}  // namespace lumel
