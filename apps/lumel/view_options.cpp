// The options of lumel view.

#include <memory>

#include <fmt/core.h>

#include "base/core/error.h"
#include "method_options.h"
#include "methods/methods.h"
#include "option_values.h"
#include "shared_options.h"
#include "viewer/session/script.h"

namespace lumel {
namespace {

constexpr const char* kSessionGroup = "Session";
constexpr int kMaxSeed = 2'147'483'647;

/// The commands of a script, for --help: name and meaning with a tab between.
std::string commands_text()
{
    std::string text =
        "\nCommands of a script, one a line; names with blanks in double quotes, # begins a "
        "comment:\n";
    for (const CommandForm& form : command_forms())
        text += fmt::format("{} {}\t{}\n", form.word, form.arguments, form.meaning);
    return text;
}

void add_script_options(Command& command, ViewArguments& view)
{
    command.add(
        kSessionGroup,
        {{"--script", "FILE.txt", "Play the commands of this file, see below", &view.run.script},
         {"--headless", "", "Open no window, only play the script", &view.headless},
         {"--folder", "FOLDER", "Output folder of the script", &view.run.folder, "the current one"},
         {.names = "--movable",
          .type = "NAME",
          .help = "Object that may be moved, rotated or deleted, by name; repeatable",
          .target = &view.options.movable,
          .default_value = "objects that are small relative to the scene",
          .repeatable = true},
         {"--budget", "MS", "Milliseconds per frame for updating the light",
          &view.options.budget_ms, text_of(view.options.budget_ms), positive()}});
}

void add_light_of_session(Command& command, SessionOptions& options)
{
    command.add(
        kSessionGroup,
        {{"--solver", names_of_methods(),
          "Show the light of this method until the first edit; see lumel methods",
          [&options](const std::string& id) {
              options.solver = SolverOptions{.method = method_of(id).defaults()};
          },
          "none: stored links"},
         {"--links", "N", "Rays stored per lumel: 4, 16, 64 or 256", &options.link_rays,
          text_of(options.link_rays), link_rays()},
         {"--residual", "PERCENT",
          "Light has converged when the unreflected share falls below this",
          [&options](double percent) { options.residual = percent / 100.0; },
          text_of(100.0 * options.residual), positive()},
         {"--error", "PERCENT",
          "Bake the scene at rest to this estimated relative error, with at most 384 rays per "
          "lumel at 2 %; 0: show the light of links",
          [&options](double percent) { options.bake_error = percent / 100.0; },
          text_of(100.0 * options.bake_error), between(0.0, kMaxErrorPercent)},
         {"--seed", "N", "Random seed", &options.seed, text_of(options.seed), whole(0, kMaxSeed)},
         {"--animation", "N", "Animation of the file, by number from 0", &options.animation,
          text_of(options.animation), whole(0, kMaxAnimations)}});
}

}  // namespace

Command view_command()
{
    const auto given = std::make_shared<ViewArguments>(ViewArguments{.run = {.folder = "."}});
    SessionOptions& options = given->options;
    Command command{.name = "view",
                    .help = "Interactive viewer: walk through a lit scene, move objects, dim lamps",
                    .footer = commands_text()};
    command.add({scene_argument(given->run.scene)});
    add_script_options(command, *given);
    add_light_of_session(command, options);
    add_picture_options(command, options.camera, options.width);
    add_light_options(command, options.lights);
    add_atlas_options(command, options.atlas);
    add_device_option(command, options.device);
    add_talk_options(command, given->talk);
    command.arguments = [given](const Command&) -> Arguments {
        if (given->headless && given->run.script.empty())
            throw Error(ErrorKind::input, "--headless", "needs --script FILE, which it plays");
        return {*given};
    };
    return command;
}

}  // namespace lumel
