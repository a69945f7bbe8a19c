// The options of lumel render.

#include <memory>

#include <CLI/CLI.hpp>

#include "command.h"
#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr int kMostPlaces = 256;
constexpr int kMostRays = 4096;

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
        ->check(whole(1, kMostPlaces));
    command
        .add_option("--eye-shots", options.shots,
                    "Shooters for glossy reflections in view, after those of the solution")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMostShots));
    CLI::Option* lobe_rays =
        command.add_option("--lobe-rays", options.rays, "Rays along the lobe at each sample point")
            ->type_name("N")
            ->capture_default_str()
            ->check(whole(0, kMostRays));
    command
        .add_option("--paths", options.paths,
                    "Trace this many paths per pixel on the processor instead, to compare with")
        ->type_name("N")
        ->check(whole(1, kMostPaths));
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
