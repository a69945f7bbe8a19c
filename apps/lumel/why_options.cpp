// The options of lumel why.

#include <memory>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "command.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

/// A place in a lightmap, as two numbers with a comma.
void add_place_options(CLI::App& app, WhyOptions& options)
{
    app.option_defaults()->group("Point of the lightmap");
    auto* lumel = app.add_option_function<std::vector<double>>(
                         "--lumel",
                         [&options](const std::vector<double>& uv) {
                             options.place = {uv[0], uv[1]};
                         },
                         "Point of the lightmap in TEXCOORD_1: 0,0 is its top left corner, 1,1 "
                         "the bottom right one")
                      ->type_name("U,V")
                      ->delimiter(',')
                      ->expected(2)
                      ->check(between(0.0, 1.0));
    auto* texel =
        app.add_option_function<std::vector<int>>(
               "--texel",
               [&options](const std::vector<int>& at) { options.texel = glm::ivec2(at[0], at[1]); },
               "The same as column and row of a texel, from 0,0")
            ->type_name("X,Y")
            ->delimiter(',')
            ->expected(2)
            ->check(whole(0, kLargestAtlas - 1));
    texel->excludes(lumel);
    app.add_option("--page", options.page, "Of several pages of the lightmap the one that is meant")
        ->type_name("N")
        ->default_val(options.page)
        ->check(whole(0, kMaxPages - 1));
    app.callback([&app] {
        if (app.count("--lumel") + app.count("--texel") == 0)
            throw Error(ErrorKind::input, "", "lumel why needs --lumel U,V or --texel X,Y");
    });
}

}  // namespace

Command why_command(CLI::App& program)
{
    const auto given = std::make_shared<WhyArguments>();
    WhyArguments& why = *given;
    CLI::App& command = *program.add_subcommand(
        "why", "List what sends light to a point of a baked lightmap, and show it in why.png");
    command.add_option("folder", why.folder, "What lumel bake wrote")
        ->required()
        ->type_name("FOLDER");
    add_place_options(command, why.options);
    command.add_option("--width", why.options.width, "Width of why.png in pixels; 0: none")
        ->group(kPictureGroup)
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(0, kLargestAtlas));
    add_device_option(command, why.options.device);
    add_talk_options(command, why.talk);
    return {&command, [given]() -> Arguments { return *given; }};
}

}  // namespace lumel
