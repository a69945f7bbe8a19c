// The options of lumel bake.

#include <memory>

#include <CLI/CLI.hpp>

#include "command.h"
#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr double kMostCheckpointSeconds = 86'400.0;  // a day

void add_resume_options(CLI::App& app, BakeOptions& options)
{
    app.option_defaults()->group(kStopGroup);
    app.add_flag("--resume", options.resume,
                 "Go on with a bake that was killed or failed, from its checkpoint in the folder; "
                 "begin anew if there is none (only links)");
    app.add_option("--checkpoint", options.checkpoint_seconds,
                   "Time between two checkpoints that --resume goes on from; 0: none (only links)")
        ->type_name("SECONDS")
        ->capture_default_str()
        ->check(between(0.0, kMostCheckpointSeconds));
}

}  // namespace

Command bake_command(CLI::App& program)
{
    const auto given = std::make_shared<BakeArguments>();
    BakeArguments& bake = *given;
    const auto method = std::make_shared<GivenMethod>();
    CLI::App& command =
        *program.add_subcommand("bake", "Solve the light of a scene into lightmaps");
    command.add_option("scene", bake.scene, "A .gltf or .glb file")->required()->type_name("FILE");
    command.add_option("folder", bake.folder, "Where the results go")
        ->required()
        ->type_name("FOLDER");
    add_light_options(command, bake.options.lights);
    add_sky_directions_option(command, bake.options);
    add_atlas_options(command, bake.options.atlas);
    add_sides_option(command, bake.options.atlas);
    command.option_defaults()->group(kMethodGroup);
    add_methods(command, *method);
    add_stop_options(command, bake.options.solver);
    add_resume_options(command, bake.options);
    add_device_option(command, bake.options.device);
    add_memory_option(command, bake.options.max_memory);
    add_half_option(command, bake.options.half);
    add_keep_lights_option(command, bake.options.keep_lights);
    add_scene_file_options(command, bake.options);
    add_only_option(command, bake.options.parts);
    add_directional_option(command, bake.options.directional);
    add_preview_option(command, bake.options.preview_width);
    command
        .add_flag("--html", bake.page,
                  "Also write report.html, a page to walk through the scene and read its light, as "
                  "lumel report does")
        ->group(kPictureGroup);
    add_dump_option(command, bake.options.dump);
    add_talk_options(command, bake.talk);
    return {&command, [given, method]() -> Arguments {
                given->options.solver.method = method->options();
                check_limits(given->options.solver);
                return *given;
            }};
}

}  // namespace lumel
