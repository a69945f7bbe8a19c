// The options of lumel why.

#include <memory>

#include "base/core/error.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

/// A place in a lightmap, as two numbers with a comma.
void add_place_options(Command& command, WhyOptions& options)
{
    const auto set_texel = [&options](std::array<double, 2> at) {
        options.texel = glm::ivec2(int(at[0]), int(at[1]));
    };
    command.add(
        "Point of the lightmap",
        {{.names = "--lumel",
          .type = "U,V",
          .help = "Point of the lightmap in TEXCOORD_1: 0,0 is its top left corner, 1,1 the bottom "
                  "right one",
          .target =
              [&options](std::array<double, 2> uv) {
                  options.place = {uv[0], uv[1]};
              },
          .check = between(0.0, 1.0)},
         {.names = "--texel",
          .type = "X,Y",
          .help = "The same as column and row of a texel, from 0,0",
          .target = set_texel,
          .check = whole(0, kLargestAtlas - 1),
          .excludes = "--lumel"},
         {"--page", "N", "Of several pages of the lightmap the one that is meant", &options.page,
          text_of(options.page), whole(0, kMaxPages - 1)}});
}

}  // namespace

Command why_command()
{
    const auto given = std::make_shared<WhyArguments>();
    WhyOptions& options = given->options;
    Command command{
        .name = "why",
        .help = "List what sends light to a point of a baked lightmap, and show it in why.png"};
    command.add({bake_argument(given->folder)});
    add_place_options(command, options);
    command.add(kPictureGroup, {{"--width", "N", "Width of why.png in pixels; 0: none",
                                 &options.width, text_of(options.width), whole(0, kLargestAtlas)}});
    add_device_option(command, options.device);
    add_talk_options(command, given->talk);
    command.arguments = [given](const Command& parsed) -> Arguments {
        if (!parsed.given("--lumel") && !parsed.given("--texel"))
            throw Error(ErrorKind::input, "", "lumel why needs --lumel U,V or --texel X,Y");
        return {*given};
    };
    return command;
}

}  // namespace lumel
