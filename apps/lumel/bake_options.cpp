// The options of lumel bake.

#include <memory>

#include <fmt/format.h>

#include "base/core/error.h"
#include "jobs/bake/lamp_maps.h"
#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr double kMaxCheckpointSeconds = 86'400.0;  // a day

void add_resume_options(Command& command, BakeOptions& options)
{
    command.add(kStopGroup, {{"--resume", "",
                              "Continue an interrupted bake from the checkpoint in its folder; "
                              "without one, start from scratch (only links)",
                              &options.resume},
                             {"--checkpoint", "SECONDS",
                              "Time between checkpoints for --resume; 0: none (only links)",
                              &options.checkpoint_seconds, text_of(options.checkpoint_seconds),
                              between(0.0, kMaxCheckpointSeconds)}});
}

/// How many links, whether to store them, and lamps that are kept apart.
struct GivenLinks {
    bool keep = false;
    std::uint32_t rays = 0;  ///< per lumel, 0: not given
    bool per_lamp = false;
    std::vector<LampGroup> groups;
};

void add_lamp_options(Command& command, GivenLinks& links)
{
    command.add(kLightmapGroup,
                {{"--per-lamp", "",
                  "Also write a map for each lamp, emissive object, sun and sky, which add up to "
                  "the lightmap: lamp-NAME.exr and lamps.json, for the sliders of lumel report, "
                  "and maps in scene.glb for three.js (only links)",
                  &links.per_lamp}});
    add_group_option(command, kLightmapGroup, "--per-lamp", links.groups);
}

void add_daylight_option(Command& command, BakeOptions& options)
{
    command.add(kLightmapGroup,
                {{"--daylight", "FILE.epw",
                  "Also write maps of daylight over the year of a weather file, of sky and sun "
                  "alone: daylight-HOUR.exr and daylight.json, for the clock and the calendar of "
                  "lumel report",
                  &options.daylight}});
}

void add_links_options(Command& command, GivenLinks& links)
{
    command.add(kMethodGroup,
                {{"--keep-links", "",
                  "Store the rays' hits in scene.lumellinks, from which lumel relight and lumel "
                  "update work at full resolution (only links)",
                  &links.keep},
                 {"--links", "N",
                  "Trace N rays from each lumel in one round, instead of as many as the error "
                  "requires: a multiple of 3, best 3 times a power of two (only links)",
                  &links.rays, "as the error requires", even_rays()}});
}

void add_file_options(Command& command, BakeArguments& bake)
{
    command.add(kLightmapGroup,
                {{"--probes", "SPACING",
                  "Also write probes.json with light probes this many metres apart, like lumel "
                  "probes --spacing, and add them to the glTF files as nodes",
                  &bake.options.probe_spacing, "", positive()}});
    add_preview_option(command, bake.options.preview_width);
    command.add(
        kPictureGroup,
        {{"--exposure", "F",
          "Factor from cd/m2 to brightness in preview.png, lightmap.png and scene-baked.glb",
          &bake.options.exposure, "fitted to what is lit", positive()},
         {"--html", "", "Also write report.html, a page to explore the bake, like lumel report",
          &bake.page}});
}

/// Throws Error{input} for options that the number of links excludes.
void set_links(const Command& command, const GivenLinks& links, BakeOptions& options)
{
    options.keep_links = links.keep;
    set_per_lamp(options, links.per_lamp, links.groups);
    if (!command.given("--links"))
        return;
    auto* method = std::get_if<LinksOptions>(&options.solver.method);
    if (!method)
        throw Error(ErrorKind::input, "--links", "is read by --solver links only");
    for (const char* option : {"--quality", "--error", "--dark-error", "--shots", "--time"})
        if (command.given(option))
            throw Error(ErrorKind::input, option,
                        "cannot be given with --links, which fixes the number of rays");
    method->even_rays = links.rays;
    options.solver.target_error = 0.0;
    options.solver.target_quality = {};
    options.solver.max_shots = 0;
}

}  // namespace

Command bake_command()
{
    const auto given = std::make_shared<BakeArguments>();
    const auto method = std::make_shared<GivenMethod>();
    const auto links = std::make_shared<GivenLinks>();
    BakeOptions& options = given->options;
    Command command{.name = "bake", .help = "Bake the light of a scene into lightmaps"};
    command.everyday_options = {"--quality", "--size",     "--sky",  "--sun",
                                "--time",    "--per-lamp", "--html", "--quiet"};
    command.add({scene_argument(given->scene), result_argument(given->folder)});
    add_light_options(command, options.lights);
    add_sky_directions_option(command, options);
    add_atlas_options(command, options.atlas);
    add_sides_option(command, options.atlas);
    add_methods(command, *method);
    add_links_options(command, *links);
    add_lamp_options(command, *links);
    add_daylight_option(command, options);
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
        given->options.solver.method = method->options();
        set_default_target(parsed, given->options.solver);
        check_limits(given->options.solver);
        set_links(parsed, *links, given->options);
        return {*given};
    };
    return command;
}

}  // namespace lumel
