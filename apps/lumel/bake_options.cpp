// The options of lumel bake.

#include <memory>

#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "command.h"
#include "links/live/link_relighter.h"
#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr double kMaxCheckpointSeconds = 86'400.0;  // a day

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
        ->check(between(0.0, kMaxCheckpointSeconds));
}

/// Links that are to be kept.
struct GivenLinks {
    bool keep = false;
    std::uint32_t rays = KeptLightOptions{}.rays;  ///< of a lumel
};

void add_keep_links_options(CLI::App& app, GivenLinks& links)
{
    app.option_defaults()->group(kMethodGroup);
    app.add_flag(
        "--keep-links", links.keep,
        "Trace a fixed number of rays from each lumel and keep them in scene.lumellinks, by "
        "which lumel relight lights the scene anew, and lumel update follows what moves, at "
        "full resolution (only links)");
    app.add_option("--links", links.rays,
                   "With --keep-links, rays that each lumel keeps: 4, 16, 64 or 256")
        ->type_name("N")
        ->capture_default_str()
        ->check(link_rays());
}

/// Throws Error{input} for options that links which are kept do not read.
std::uint32_t kept_rays(const CLI::App& command, const GivenLinks& links)
{
    if (!links.keep) {
        if (command.count("--links") > 0)
            throw Error(ErrorKind::input, "--links", "is read with --keep-links only");
        return 0;
    }
    for (const char* option : {"--error", "--dark-error", "--shots", "--time"})
        if (command.count(option) > 0)
            throw Error(ErrorKind::input, option,
                        "is not read with --keep-links, which traces the same number of rays from "
                        "each lumel; choose it with --links");
    return links.rays;
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
    const auto links = std::make_shared<GivenLinks>();
    add_keep_links_options(command, *links);
    add_stop_options(command, bake.options.solver);
    add_resume_options(command, bake.options);
    add_device_option(command, bake.options.device);
    add_memory_option(command, bake.options.max_memory);
    add_half_option(command, bake.options.half);
    add_keep_lights_option(command, bake.options.keep_lights);
    add_scene_file_options(command, bake.options);
    add_only_option(command, bake.options.parts);
    add_directional_option(command, bake.options.directional);
    command
        .add_option("--probes", bake.options.probe_spacing,
                    "Also write probes.json, as lumel probes --spacing does: light probes this "
                    "many metres apart; and put them into the glTF files as nodes")
        ->group(kLightmapGroup)
        ->type_name("SPACING")
        ->check(positive());
    add_preview_option(command, bake.options.preview_width);
    command
        .add_flag("--html", bake.page,
                  "Also write report.html, a page to walk through the scene and read its light, as "
                  "lumel report does")
        ->group(kPictureGroup);
    add_dump_option(command, bake.options.dump);
    add_talk_options(command, bake.talk);
    return {&command, [given, method, links, &command]() -> Arguments {
                given->options.solver.method = method->options();
                check_limits(given->options.solver);
                given->options.keep_links = kept_rays(command, *links);
                return *given;
            }};
}

}  // namespace lumel
