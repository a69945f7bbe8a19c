// The options of lumel play.

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "base/core/error.h"
#include "command.h"
#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

/// Directions follow light by the papers' scheme alone; links that are kept are traced on the host,
/// from points of their lumels.
const std::vector<OmittedOption> kOmitted = {{"scheme"}, {"sampling", "links"}, {"rays", "links"}};

constexpr const char* kAnimationGroup = "Animation";

constexpr int kMaxFrames = 100'000;
constexpr int kMaxAnimations = 1'000'000;
constexpr double kMinLeak = 1e-4, kMaxLeak = 0.5;
constexpr double kMaxFps = 1000.0;  // pictures a second

const Choices<Redistribution> kRedistributions = {{"incremental", Redistribution::incremental},
                                                  {"cross", Redistribution::cross}};

const Choices<Film> kFilms = {{"mp4", Film::mp4}, {"webm", Film::webm}, {"none", Film::none}};

/// What is played, and how closely the light follows.
void add_play_options(CLI::App& app, PlayOptions& options)
{
    app.option_defaults()->group(kAnimationGroup);
    app.add_option("--frames", options.frames, "Number of frames")
        ->type_name("N")
        ->default_str("the animation's length")
        ->check(whole(1, kMaxFrames));
    app.add_option("--fps", options.fps, "Frames per second of the animation")
        ->type_name("N")
        ->capture_default_str()
        ->check(between(1.0 / kMaxFps, kMaxFps));
    app.add_option("--animation", options.animation, "Animation of the file by its number, from 0")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMaxAnimations));
    add_choice(app, "--redistribution", options.redistribution, kRedistributions,
               "With --solver progressive, how light follows a move: incremental shoots again past "
               "the old and the new position, "
               "as exact as a new solution; cross uses only views from what moves, which is faster "
               "where that is small");
    app.add_option("--leak", options.leak,
                   "With --solver directions, the share of the running mean that each direction "
                   "replaces: more follows faster and is noisier")
        ->type_name("F")
        ->capture_default_str()
        ->check(between(kMinLeak, kMaxLeak));
    app.add_option("--links", options.link_rays,
                   "With --solver links, rays that each lumel keeps: 4, 16, 64 or 256")
        ->type_name("N")
        ->capture_default_str()
        ->check(link_rays());
    app.add_option(
           "--budget", options.budget_ms,
           "Milliseconds for the light of each frame; where they are not enough it lags behind")
        ->type_name("MS")
        ->default_str("as needed")
        ->check(positive());
    app.add_option_function<double>(
           "--residual", [&options](double percent) { options.residual = percent / 100.0; },
           "Light left to be shot, or to bounce, as a part of all, at which a solution is at rest; "
           "with --solver directions, what is left of the light before a change")
        ->type_name("PERCENT")
        ->default_str(fmt::format("{:g}, {:g} with directions, {:g} with links",
                                  100.0 * options.residual, 100.0 * LeakyOptions{}.residual,
                                  100.0 * LiveLinksOptions{}.residual))
        ->check(positive());
    add_choice(app, "--film", options.film, kFilms,
               "Film of the frames, where ffmpeg is installed: play.mp4 or play.webm");
    app.add_option("--exposure", options.exposure,
                   "Factor from cd/m2 to brightness, the same for all frames")
        ->type_name("F")
        ->default_str("as suits the first frame")
        ->check(positive());
}

/// Throws Error{input} if an option was given that is of another method.
void refuse_others(const CLI::App& command, const std::string& method)
{
    const std::pair<const char*, const char*> owners[] = {
        {"--redistribution", "progressive"}, {"--leak", "directions"}, {"--links", "links"}};
    for (const auto& [option, owner] : owners)
        if (method != owner && command.count(option) > 0)
            throw Error(ErrorKind::input, option, "is not read by --solver " + method);
}

/// Where the command does not say otherwise.
double residual_of(const MethodOptions& method)
{
    if (std::holds_alternative<DirectionsOptions>(method))
        return LeakyOptions{}.residual;
    return std::holds_alternative<LinksOptions>(method) ? LiveLinksOptions{}.residual
                                                        : LiveOptions{}.residual;
}

}  // namespace

Command play_command(CLI::App& program)
{
    const auto given = std::make_shared<PlayArguments>();
    PlayArguments& play = *given;
    const auto method =
        std::make_shared<GivenMethod>(GivenMethod{.id = method_of(ProgressiveOptions{}).id});
    CLI::App& command = *program.add_subcommand(
        "play", "Render a scene's animation and correct the light from frame to frame");
    PlayOptions& options = play.options;
    command.add_option("scene", play.scene, "A .gltf or .glb file")->required()->type_name("FILE");
    command.add_option("folder", play.folder, "Where the results go")
        ->required()
        ->type_name("FOLDER");
    add_play_options(command, options);
    add_picture_options(command, options.camera, options.width);
    add_atlas_options(command, options.atlas);
    add_methods(command, *method,
                {method_of(ProgressiveOptions{}).id, method_of(LinksOptions{}).id,
                 method_of(DirectionsOptions{}).id},
                kOmitted);
    add_device_option(command, options.device);
    add_talk_options(command, play.talk);
    return {&command, [given, method, &command]() -> Arguments {
                const MethodOptions chosen = method->options();
                refuse_omitted(*method, kOmitted);
                refuse_others(command, method->id);
                if (command.count("--residual") == 0)
                    given->options.residual = residual_of(chosen);
                if (const auto* links = std::get_if<LinksOptions>(&chosen))
                    given->options.solver = *links;
                else if (const auto* directions = std::get_if<DirectionsOptions>(&chosen))
                    given->options.solver = *directions;
                else
                    given->options.solver = std::get<ProgressiveOptions>(chosen);
                return *given;
            }};
}

}  // namespace lumel
