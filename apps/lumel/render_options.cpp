// The options of lumel render.

#include <memory>

#include "base/core/error.h"
#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr int kMaxPlaces = 256;
constexpr int kMaxRays = 4096;
constexpr int kMaxFrames = 100'000;
constexpr int kMaxAnimations = 1'000'000;
constexpr double kMaxFps = 1000.0;   // pictures a second
constexpr double kMaxKept = 1000.0;  // frames

void add_film_options(Command& command, FilmOptions& film)
{
    command.add(
        "Animation",
        {{"--frames", "N",
          "Make so many pictures of the scene's animation, each of which goes on from the "
          "light of the one before",
          &film.frames, "", whole(1, kMaxFrames)},
         {.names = "--fps",
          .type = "N",
          .help = "Frames per second of the animation",
          .default_value = text_of(film.fps),
          .target = &film.fps,
          .check = between(1.0 / kMaxFps, kMaxFps),
          .needs = "--frames"},
         {.names = "--animation",
          .type = "N",
          .help = "Animation of the file by its number, from 0",
          .default_value = text_of(film.animation),
          .target = &film.animation,
          .check = whole(0, kMaxAnimations),
          .needs = "--frames"},
         {.names = "--keep",
          .type = "F",
          .help = "What a frame keeps of the average of the one before, in terms of that one's "
                  "iterations; more is less noise and light that lags behind",
          .default_value = text_of(film.kept),
          .target = &film.kept,
          .check = between(0.0, kMaxKept),
          .needs = "--frames"},
         {.names = "--fresh",
          .help = "Solve each frame from nothing",
          .target = &film.fresh,
          .needs = "--frames"}});
}

void add_sample_options(Command& command, RenderOptions& options)
{
    command.add(kPictureGroup,
                {{"--height", "N", "Height of the picture in pixels", &options.height,
                  "from the camera", whole(1, kLargestAtlas)},
                 {"--places", "N", "Sample points in each pixel", &options.sets,
                  text_of(options.sets), whole(1, kMaxPlaces)},
                 {"--eye-shots", "N",
                  "Shooters for glossy reflections in view, after those of the solution",
                  &options.shots, text_of(options.shots), whole(0, kMaxShots)},
                 {"--lobe-rays", "N", "Rays along the lobe at each sample point", &options.rays,
                  text_of(options.rays), whole(0, kMaxRays)},
                 {"--paths", "N",
                  "Trace this many paths per pixel on the processor instead, to compare with",
                  &options.paths, "", whole(1, kMaxPaths)}});
}

}  // namespace

Command render_command()
{
    const auto given = std::make_shared<RenderArguments>();
    const auto method = std::make_shared<GivenMethod>(
        GivenMethod{.id = method_of(given->options.bake.solver.method).id});
    RenderOptions& options = given->options;
    Command command{
        .name = "render",
        .help = "Make a picture of a scene from one of its cameras, glossy reflections included"};
    command.add({scene_argument(given->scene),
                 {.names = "picture",
                  .type = "FILE",
                  .help = "PNG, or EXR of radiance in cd/m2",
                  .target = &given->picture,
                  .required = true}});
    add_picture_options(command, options.camera, options.width);
    add_sample_options(command, options);
    add_film_options(command, options.film);
    add_light_options(command, options.bake.lights);
    add_sky_directions_option(command, options.bake);
    add_atlas_options(command, options.bake.atlas);
    add_one_method(command, *method);
    add_stop_options(command, options.bake.solver);
    add_device_option(command, options.bake.device);
    add_dump_option(command, options.bake.dump);
    add_talk_options(command, given->talk);
    command.arguments = [given, method](const Command& parsed) -> Arguments {
        SolverOptions& solver = given->options.bake.solver;
        drop_default_error(parsed, solver);
        solver.method = method->options();
        if (parsed.given("--lobe-rays") && is_papers(solver.method))
            throw Error(ErrorKind::input, "--lobe-rays",
                        "does nothing with --scheme paper, which has no rays");
        check_limits(solver);
        return {*given};
    };
    return command;
}

}  // namespace lumel
