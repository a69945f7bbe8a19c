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

constexpr int kMaxFrames = 100'000;
constexpr int kMaxAnimations = 1'000'000;
constexpr double kMinLeak = 1e-4, kMaxLeak = 0.5;
constexpr double kMaxFps = 1000.0;  // pictures a second

const Choices<Redistribution> kRedistributions = {{"incremental", Redistribution::incremental},
                                                  {"cross", Redistribution::cross}};

const Choices<Film> kFilms = {{"mp4", Film::mp4}, {"webm", Film::webm}, {"none", Film::none}};

/// What is played.
void add_animation_options(Command& command, PlayOptions& options)
{
    command.add(kAnimationGroup,
                {{"--frames", "N", "Number of frames", &options.frames, "the animation's length",
                  whole(1, kMaxFrames)},
                 {"--fps", "N", "Frames per second of the animation", &options.fps,
                  text_of(options.fps), between(1.0 / kMaxFps, kMaxFps)},
                 {"--animation", "N", "Animation of the file by its number, from 0",
                  &options.animation, text_of(options.animation), whole(0, kMaxAnimations)}});
}

/// How closely light follows.
void add_follow_options(Command& command, PlayOptions& options)
{
    command.add(
        kAnimationGroup,
        {choice(options.redistribution, kRedistributions,
                {"--redistribution", "",
                 "With --solver progressive, how light follows a move: incremental shoots "
                 "again past the old and the new position, as exact as a new solution; "
                 "cross uses only views from what moves, which is faster where that is "
                 "small"}),
         {"--leak", "F",
          "With --solver directions, the share of the running mean that each direction "
          "replaces: more follows faster and is noisier",
          &options.leak, text_of(options.leak), between(kMinLeak, kMaxLeak)},
         {"--links", "N", "With --solver links, rays that each lumel keeps: 4, 16, 64 or 256",
          &options.link_rays, text_of(options.link_rays), link_rays()},
         {"--budget", "MS",
          "Milliseconds for the light of each frame; where they are not enough it lags "
          "behind",
          &options.budget_ms, "as needed", positive()},
         {.names = "--residual",
          .type = "PERCENT",
          .help = "Light left to be shot, or to bounce, as a part of all, at which a solution is "
                  "at rest; with --solver directions, what is left of the light before a change",
          .default_value =
              fmt::format("{:g}, {:g} with directions, {:g} with links", 100.0 * options.residual,
                          100.0 * LeakyOptions{}.residual, 100.0 * LiveLinksOptions{}.residual),
          .target = [&options](double percent) { options.residual = percent / 100.0; },
          .check = positive()}});
}

void add_film_options(Command& command, PlayOptions& options)
{
    command.add(kAnimationGroup,
                {choice(options.film, kFilms,
                        {"--film", "",
                         "Film of the frames, where ffmpeg is installed: play.mp4 or play.webm"}),
                 {"--exposure", "F", "Factor from cd/m2 to brightness, the same for all frames",
                  &options.exposure, "as suits the first frame", positive()}});
}

/// Throws Error{input} if an option was given that is of another method.
void refuse_others(const Command& command, const std::string& method)
{
    const std::pair<const char*, const char*> owners[] = {
        {"--redistribution", "progressive"}, {"--leak", "directions"}, {"--links", "links"}};
    for (const auto& [option, owner] : owners)
        if (method != owner && command.given(option))
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

PlayArguments with_method(PlayArguments play, const Command& command, const GivenMethod& method)
{
    const MethodOptions chosen = method.options();
    refuse_omitted(method, kOmitted);
    refuse_others(command, method.id);
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
                    .help = "Render a scene's animation and correct the light from frame to frame"};
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
