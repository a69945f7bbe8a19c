// The options of lumel bake.

#include <memory>

#include "base/core/error.h"
#include "links/live/link_relighter.h"
#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr double kMaxCheckpointSeconds = 86'400.0;  // a day

void add_resume_options(Command& command, BakeOptions& options)
{
    command.add(kStopGroup,
                {{"--resume", "",
                  "Go on with a bake that was killed or failed, from its checkpoint in the folder; "
                  "begin anew if there is none (only links)",
                  &options.resume},
                 {"--checkpoint", "SECONDS",
                  "Time between two checkpoints that --resume goes on from; 0: none (only links)",
                  &options.checkpoint_seconds, text_of(options.checkpoint_seconds),
                  between(0.0, kMaxCheckpointSeconds)}});
}

/// Links that are to be kept.
struct GivenLinks {
    bool keep = false;
    std::uint32_t rays = KeptLightOptions{}.rays;  ///< of a lumel
};

void add_keep_links_options(Command& command, GivenLinks& links)
{
    command.add(kMethodGroup,
                {{"--keep-links", "",
                  "Trace a fixed number of rays from each lumel and keep them in "
                  "scene.lumellinks, by which lumel relight lights the scene anew, and lumel "
                  "update follows what moves, at full resolution (only links)",
                  &links.keep},
                 {"--links", "N", "With --keep-links, rays that each lumel keeps: 4, 16, 64 or 256",
                  &links.rays, text_of(links.rays), link_rays()}});
}

void add_file_options(Command& command, BakeArguments& bake)
{
    command.add(kLightmapGroup,
                {{"--probes", "SPACING",
                  "Also write probes.json, as lumel probes --spacing does: light probes this many "
                  "metres apart; and put them into the glTF files as nodes",
                  &bake.options.probe_spacing, "", positive()}});
    add_preview_option(command, bake.options.preview_width);
    command.add(kPictureGroup,
                {{"--html", "",
                  "Also write report.html, a page to walk through the scene and read its light, as "
                  "lumel report does",
                  &bake.page}});
}

/// Throws Error{input} for options that links which are kept do not read.
std::uint32_t kept_rays(const Command& command, const GivenLinks& links)
{
    if (!links.keep) {
        if (command.given("--links"))
            throw Error(ErrorKind::input, "--links", "is read with --keep-links only");
        return 0;
    }
    for (const char* option : {"--error", "--dark-error", "--shots", "--time"})
        if (command.given(option))
            throw Error(ErrorKind::input, option,
                        "is not read with --keep-links, which traces the same number of rays from "
                        "each lumel; choose it with --links");
    return links.rays;
}

}  // namespace

Command bake_command()
{
    const auto given = std::make_shared<BakeArguments>();
    const auto method = std::make_shared<GivenMethod>();
    const auto links = std::make_shared<GivenLinks>();
    BakeOptions& options = given->options;
    Command command{.name = "bake", .help = "Solve the light of a scene into lightmaps"};
    command.add({scene_argument(given->scene), result_argument(given->folder)});
    add_light_options(command, options.lights);
    add_sky_directions_option(command, options);
    add_atlas_options(command, options.atlas);
    add_sides_option(command, options.atlas);
    add_methods(command, *method);
    add_keep_links_options(command, *links);
    add_stop_options(command, options.solver);
    add_resume_options(command, options);
    add_device_option(command, options.device);
    add_memory_option(command, options.max_memory);
    add_half_option(command, options.half);
    add_keep_lights_option(command, options.keep_lights);
    add_scene_file_options(command, options);
    add_only_option(command, options.parts);
    add_directional_option(command, options.directional);
    add_file_options(command, *given);
    add_dump_option(command, options.dump);
    add_talk_options(command, given->talk);
    command.arguments = [given, method, links](const Command& parsed) -> Arguments {
        drop_default_error(parsed, given->options.solver);
        given->options.solver.method = method->options();
        check_limits(given->options.solver);
        given->options.keep_links = kept_rays(parsed, *links);
        return {*given};
    };
    return command;
}

}  // namespace lumel
