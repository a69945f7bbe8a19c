// The options of lumel view.

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "base/core/error.h"
#include "command.h"
#include "method_options.h"
#include "methods/methods.h"
#include "option_values.h"
#include "shared_options.h"
#include "viewer/session/script.h"

namespace lumel {
namespace {

constexpr const char* kSessionGroup = "Session";
constexpr int kMaxAnimations = 1'000'000;
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

void add_session_options(CLI::App& app, ViewArguments& view)
{
    app.option_defaults()->group(kSessionGroup);
    app.add_option("--script", view.run.script, "File of commands that are played, see below")
        ->type_name("FILE.txt");
    app.add_flag("--headless", view.headless, "Open no window: play the script alone");
    app.add_option("--folder", view.run.folder, "Where the files of the script go")
        ->type_name("FOLDER")
        ->default_str("the current one");
    app.add_option("--movable", view.options.movable,
                   "Name of what may be moved, turned and deleted; may be repeated")
        ->type_name("NAME")
        ->default_str("what is small beside the scene")
        ->allow_extra_args(false);  // one at a time, so that a scene may follow
    app.add_option("--budget", view.options.budget_ms, "Milliseconds for the light of each frame")
        ->type_name("MS")
        ->capture_default_str()
        ->check(positive());
}

void add_method_options(CLI::App& app, SessionOptions& options)
{
    app.option_defaults()->group(kSessionGroup);
    app.add_option_function<std::string>(
           "--solver",
           [&options](const std::string& id) {
               options.solver = SolverOptions{.method = method_of(id).defaults()};
           },
           "Show the light of this method first, before the first edit; see lumel methods")
        ->type_name(names_of_methods())
        ->default_str("none: links that are kept");
    app.add_option("--links", options.link_rays, "Rays that each lumel keeps: 4, 16, 64 or 256")
        ->type_name("N")
        ->capture_default_str()
        ->check(link_rays());
    app.add_option_function<double>(
           "--residual", [&options](double percent) { options.residual = percent / 100.0; },
           "Light left to bounce, as a part of all, at which light is at rest")
        ->type_name("PERCENT")
        ->default_str(fmt::format("{:g}", 100.0 * options.residual))
        ->check(positive());
    app.add_option("--seed", options.seed, "Random seed")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMaxSeed));
    app.add_option("--animation", options.animation, "Animation of the file by its number, from 0")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kMaxAnimations));
}

}  // namespace

Command view_command(CLI::App& program)
{
    const auto given = std::make_shared<ViewArguments>();
    ViewArguments& view = *given;
    view.run.folder = ".";
    CLI::App& command = *program.add_subcommand(
        "view", "Walk through a lit scene while things are moved and lamps dimmed");
    command.add_option("scene", view.run.scene, "A .gltf or .glb file")
        ->required()
        ->type_name("FILE");
    add_session_options(command, view);
    add_method_options(command, view.options);
    add_picture_options(command, view.options.camera, view.options.width);
    add_light_options(command, view.options.lights);
    add_atlas_options(command, view.options.atlas);
    add_device_option(command, view.options.device);
    add_talk_options(command, view.talk);
    command.footer(commands_text());
    command.callback([&view] {
        if (view.headless && view.run.script.empty())
            throw Error(ErrorKind::input, "--headless", "needs --script FILE, which it plays");
    });
    return {&command, [given]() -> Arguments { return *given; }};
}

}  // namespace lumel
