// The options of lumel play.

#include <memory>

#include <fmt/core.h>

#include "base/core/error.h"
#include "method_options.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

/// Directions follow light by the papers' scheme alone; links that are kept are traced on the host,
/// from points of their lumels.
const std::vector<OmittedOption> kOmitted = {{"scheme"}, {"sampling", "links"}, {"rays", "links"}};

constexpr const char* kAnimationGroup = "Animation";

constexpr double kMinLeak = 1e-4, kMaxLeak = 0.5;

const Choices<Redistribution> kRedistributions = {
    {"incremental", Redistribution::incremental},
    {"cross", Redistribution::cross},
    {"paper-incremental", Redistribution::paper_incremental},
    {"paper-cross", Redistribution::paper_cross},
    {"paper-cross-incremental", Redistribution::paper_cross_incremental}};

const Choices<Film> kFilms = {{"mp4", Film::mp4}, {"webm", Film::webm}, {"none", Film::none}};

/// Frames to render.
void add_animation_options(Command& command, PlayOptions& options)
{
    command.add(kAnimationGroup,
                {{"--frames", "N", "Number of frames", &options.frames, "the animation's length",
                  whole(1, kMaxFrames)},
                 {"--fps", "N", "Frames per second of the animation", &options.fps,
                  text_of(options.fps), between(1.0 / kMaxFps, kMaxFps)},
                 {"--animation", "N", "Animation of the file, by number from 0", &options.animation,
                  text_of(options.animation), whole(0, kMaxAnimations)}});
}

/// Updates of the light between frames.
void add_follow_options(Command& command, PlayOptions& options)
{
    command.add(
        kAnimationGroup,
        {choice(
             options.redistribution, kRedistributions,
             {"--redistribution", "",
              "With --solver progressive, update after a move: incremental shoots again past "
              "the old and the new position and is as exact as a new solution; cross uses only "
              "views from the moved objects, which is faster if they are small; "
              "paper-incremental, paper-cross and paper-cross-incremental are those of [Hoef13], "
              "for comparison"}),
         {"--leak", "F",
          "With --solver directions, the share of the running mean that each direction replaces; "
          "higher values follow changes faster but are noisier",
          &options.leak, text_of(options.leak), between(kMinLeak, kMaxLeak)},
         {"--links", "N", "With --solver links, rays stored per lumel: 4, 16, 64 or 256",
          &options.link_rays, text_of(options.link_rays), link_rays()},
         {"--error", "PERCENT",
          "With --solver links and without --budget, bake each frame to this estimated relative "
          "error, with at most 384 rays per lumel at 2 %; 0: show the light of links",
          [&options](double percent) { options.bake_error = percent / 100.0; },
          text_of(100.0 * options.bake_error), between(0.0, kMaxErrorPercent)},
         {"--budget", "MS",
          "Milliseconds per frame for updating the light; if they are not enough, it lags behind",
          &options.budget_ms, "unlimited", positive()},
         {"--residual", "PERCENT",
          "Stop when unshot or unreflected light falls below this share; with --solver directions, "
          "when this share of the light before a change is left",
          [&options](double percent) { options.residual = percent / 100.0; },
          fmt::format("{:g}, {:g} with directions, {:g} with links", 100.0 * options.residual,
                      100.0 * LeakyOptions{}.residual, 100.0 * LiveLinksOptions{}.residual),
          positive()}});
}

void add_film_options(Command& command, PlayOptions& options)
{
    command.add(kAnimationGroup,
                {choice(options.film, kFilms,
                        {"--film", "",
                         "Encode the frames as play.mp4 or play.webm, if ffmpeg is installed"}),
                 {"--exposure", "F", "Factor from cd/m2 to brightness, for all frames",
                  &options.exposure, "from the first frame", positive()}});
}

/// Throws Error{input} if an option was given that is of another method.
void refuse_others(const Command& command, const std::string& method)
{
    const std::pair<const char*, const char*> owners[] = {{"--redistribution", "progressive"},
                                                          {"--leak", "directions"},
                                                          {"--links", "links"},
                                                          {"--error", "links"}};
    for (const auto& [option, owner] : owners)
        if (method != owner && command.given(option))
            throw Error(ErrorKind::input, option, "is not read by --solver " + method);
}

/// Default residual of a method.
double residual_of(const MethodOptions& method)
{
    if (std::holds_alternative<DirectionsOptions>(method))
        return LeakyOptions{}.residual;
    return std::holds_alternative<LinksOptions>(method) ? LiveLinksOptions{}.residual
                                                        : LiveOptions{}.residual;
}

PlayArguments with_method(PlayArguments play, const Command& command, const GivenMethod& method)
{
    const MethodOptions chosen = method.options();
    refuse_omitted(method, kOmitted);
    refuse_others(command, method.id);
    if (command.given("--error") && play.options.bake_error > 0.0 && command.given("--budget"))
        throw Error(ErrorKind::input, "--error",
                    "bakes frames, which takes longer than a --budget");
    if (!command.given("--residual"))
        play.options.residual = residual_of(chosen);
    if (const auto* links = std::get_if<LinksOptions>(&chosen))
        play.options.solver = *links;
    else if (const auto* directions = std::get_if<DirectionsOptions>(&chosen))
        play.options.solver = *directions;
    else
        play.options.solver = std::get<ProgressiveOptions>(chosen);
    return play;
}

}  // namespace

Command play_command()
{
    const auto given = std::make_shared<PlayArguments>();
    const auto method =
        std::make_shared<GivenMethod>(GivenMethod{.id = method_of(ProgressiveOptions{}).id});
    PlayOptions& options = given->options;
    Command command{.name = "play",
                    .help = "Render a scene's animation, updating the light from frame to frame"};
    command.add({scene_argument(given->scene), result_argument(given->folder)});
    add_animation_options(command, options);
    add_follow_options(command, options);
    add_film_options(command, options);
    add_picture_options(command, options.camera, options.width);
    add_atlas_options(command, options.atlas);
    add_methods(command, *method,
                {method_of(ProgressiveOptions{}).id, method_of(LinksOptions{}).id,
                 method_of(DirectionsOptions{}).id},
                kOmitted);
    add_device_option(command, options.device);
    add_talk_options(command, given->talk);
    command.arguments = [given, method](const Command& parsed) -> Arguments {
        return {with_method(*given, parsed, *method)};
    };
    return command;
}

}  // namespace lumel
