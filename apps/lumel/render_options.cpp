// The options of lumel render.

#include <algorithm>
#include <array>
#include <memory>

#include "base/core/error.h"
#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr int kMaxPlaces = 256;
constexpr int kMaxRays = 4096;
constexpr const char* kSeedOption = "seed";
/// Side of the map that glossy light is solved on, if none is given [texels]: the more lumels, the
/// more shooters a clean image takes.
constexpr int kGlossySide = 128;
/// Options that tell the number of texels.
constexpr std::array kSizes = {"--size", "--max-size", "--texels-per-metre", "--density"};
constexpr double kMaxKept = 1000.0;  // frames

void add_film_options(Command& command, FilmOptions& film)
{
    command.add("Animation",
                {{"--frames", "N",
                  "Render this many frames of the scene's animation; each starts from the light of "
                  "the one before",
                  &film.frames, "", whole(1, kMaxFrames)},
                 {.names = "--fps",
                  .type = "N",
                  .help = "Frames per second of the animation",
                  .target = &film.fps,
                  .default_value = text_of(film.fps),
                  .check = between(1.0 / kMaxFps, kMaxFps),
                  .needs = "--frames"},
                 {.names = "--animation",
                  .type = "N",
                  .help = "Animation of the file, by number from 0",
                  .target = &film.animation,
                  .default_value = text_of(film.animation),
                  .check = whole(0, kMaxAnimations),
                  .needs = "--frames"},
                 {.names = "--keep",
                  .type = "F",
                  .help = "Weight of the previous frame's average, relative to its number of "
                          "iterations; higher values reduce noise, but light lags behind",
                  .target = &film.kept,
                  .default_value = text_of(film.kept),
                  .check = between(0.0, kMaxKept),
                  .needs = "--frames"},
                 {.names = "--fresh",
                  .help = "Solve each frame from scratch",
                  .target = &film.fresh,
                  .needs = "--frames"}});
}

void add_sample_options(Command& command, RenderOptions& options)
{
    command.add(
        kPictureGroup,
        {{"--height", "N", "Height of the image in pixels", &options.height, "from the camera",
          whole(1, kLargestAtlas)},
         {"--places", "N", "Sample points per pixel", &options.sets, text_of(options.sets),
          whole(1, kMaxPlaces)},
         {"--eye-shots", "N",
          "Additional shooters for glossy reflections in view, after the solution", &options.shots,
          text_of(options.shots), whole(0, kMaxShots)},
         {"--lobe-rays", "N", "Rays along the BRDF lobe per sample point", &options.rays,
          text_of(options.rays), whole(0, kMaxRays)},
         {"--paths", "N",
          "Path-trace the image on the CPU instead, with this many paths per pixel, for comparison",
          &options.paths, "", whole(1, kMaxPaths)}});
}

/// Images of lamps are made from the light of links, whose seed is the only option of a method that
/// they read.
LinksOptions links_of(const GivenMethod& given, std::vector<LampGroup> groups)
{
    for (const auto& [option, value] : given.values)
        if (option != kSeedOption)
            throw Error(ErrorKind::input, "--" + option, "is not read with --layers");
    return {.seed = seed_of(given.options()), .per_lamp = true, .groups = std::move(groups)};
}

}  // namespace

Command render_command()
{
    const auto given = std::make_shared<RenderArguments>();
    const auto method = std::make_shared<GivenMethod>(
        GivenMethod{.id = method_of(given->options.bake.solver.method).id});
    RenderOptions& options = given->options;
    Command command{.name = "render",
                    .help = "Render a scene from one of its cameras, with glossy reflections"};
    command.add({scene_argument(given->scene),
                 {.names = "picture",
                  .type = "FILE",
                  .help = "Image to write: PNG, or EXR with radiance in cd/m2",
                  .target = &given->picture,
                  .required = true}});
    add_picture_options(command, options.camera, options.width);
    add_sample_options(command, options);
    const auto groups = std::make_shared<std::vector<LampGroup>>();
    command.add(
        kPictureGroup,
        {{"--layers", "",
          "Also write an image of each lamp, as EXR and as a layer for web pages, and light "
          "the scene as lumel bake does",
          &options.layers}});
    add_group_option(command, kPictureGroup, "--layers", *groups);
    add_film_options(command, options.film);
    add_light_options(command, options.bake.lights);
    add_sky_directions_option(command, options.bake);
    add_atlas_options(command, options.bake.atlas);
    add_one_method(command, *method);
    add_stop_options(command, options.bake.solver);
    add_device_option(command, options.bake.device);
    add_dump_option(command, options.bake.dump);
    add_talk_options(command, given->talk);
    command.arguments = [given, method, groups](const Command& parsed) -> Arguments {
        SolverOptions& solver = given->options.bake.solver;
        given->options.layers |= !groups->empty();
        if (given->options.layers) {
            solver.method = links_of(*method, std::move(*groups));
            given->options.bake.atlas.sides = Sides::automatic;
        } else {
            solver.method = method->options();
            if (std::ranges::none_of(kSizes, [&](const char* size) { return parsed.given(size); }))
                given->options.bake.atlas.size = kGlossySide;
        }
        set_default_target(parsed, solver);
        if (parsed.given("--lobe-rays") && is_papers(solver.method))
            throw Error(ErrorKind::input, "--lobe-rays",
                        "does nothing with --scheme paper, which has no rays");
        check_limits(solver);
        return {*given};
    };
    return command;
}

}  // namespace lumel
