// The options of lumel render.

#include <memory>

#include <CLI/CLI.hpp>

#include "command.h"
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

void add_film_options(CLI::App& app, FilmOptions& film)
{
    app.option_defaults()->group("Animation");
    CLI::Option* frames =
        app.add_option("--frames", film.frames,
                       "Make so many pictures of the scene's animation, each of which goes on from "
                       "the light of the one before")
            ->type_name("N")
            ->check(whole(1, kMaxFrames));
    app.add_option("--fps", film.fps, "Frames per second of the animation")
        ->type_name("N")
        ->capture_default_str()
        ->check(between(1.0 / kMaxFps, kMaxFps))
        ->needs(frames);
    app.add_option("--animation", film.animation, "Animation of the file by its number, from 0")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMaxAnimations))
        ->needs(frames);
    app.add_option("--keep", film.kept,
                   "What a frame keeps of the average of the one before, in terms of that one's "
                   "iterations; more is less noise and light that lags behind")
        ->type_name("F")
        ->capture_default_str()
        ->check(between(0.0, kMaxKept))
        ->needs(frames);
    app.add_flag("--fresh", film.fresh, "Solve each frame from nothing")->needs(frames);
}

}  // namespace

Command render_command(CLI::App& program)
{
    const auto given = std::make_shared<RenderArguments>();
    RenderArguments& render = *given;
    const auto method = std::make_shared<GivenMethod>(
        GivenMethod{.id = method_of(given->options.bake.solver.method).id});
    CLI::App& command = *program.add_subcommand(
        "render", "Make a picture of a scene from one of its cameras, glossy reflections included");
    RenderOptions& options = render.options;
    command.add_option("scene", render.scene, "A .gltf or .glb file")
        ->required()
        ->type_name("FILE");
    command.add_option("picture", render.picture, "PNG, or EXR of radiance in cd/m2")
        ->required()
        ->type_name("FILE");
    add_picture_options(command, options.camera, options.width);
    command.add_option("--height", options.height, "Height of the picture in pixels")
        ->type_name("N")
        ->default_str("from the camera")
        ->check(whole(1, kLargestAtlas));
    command.add_option("--places", options.sets, "Sample points in each pixel")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kMaxPlaces));
    command
        .add_option("--eye-shots", options.shots,
                    "Shooters for glossy reflections in view, after those of the solution")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMaxShots));
    CLI::Option* lobe_rays =
        command.add_option("--lobe-rays", options.rays, "Rays along the lobe at each sample point")
            ->type_name("N")
            ->capture_default_str()
            ->check(whole(0, kMaxRays));
    command
        .add_option("--paths", options.paths,
                    "Trace this many paths per pixel on the processor instead, to compare with")
        ->type_name("N")
        ->check(whole(1, kMaxPaths));
    add_film_options(command, options.film);
    add_light_options(command, options.bake.lights);
    add_sky_directions_option(command, options.bake);
    add_atlas_options(command, options.bake.atlas);
    command.option_defaults()->group(kMethodGroup);
    add_one_method(command, *method);
    add_stop_options(command, options.bake.solver);
    add_device_option(command, options.bake.device);
    add_dump_option(command, options.bake.dump);
    add_talk_options(command, render.talk);
    return {&command, [given, method, lobe_rays]() -> Arguments {
                given->options.bake.solver.method = method->options();
                if (lobe_rays->count() > 0 && is_papers(given->options.bake.solver.method))
                    throw Error(ErrorKind::input, "--lobe-rays",
                                "does nothing with --scheme paper, which has no rays");
                check_limits(given->options.bake.solver);
                return *given;
            }};
}

}  // namespace lumel
