// The options of lumel compare.

#include <memory>

#include "option_values.h"
#include "shared_options.h"

namespace lumel {

Command compare_command()
{
    const auto given = std::make_shared<CompareArguments>();
    Command command{.name = "compare", .help = "Measure how far map A is from map B"};
    command.add({{.names = "A",
                  .type = "FILE",
                  .help = "The map to measure, an EXR file",
                  .target = &given->map,
                  .required = true},
                 {.names = "B",
                  .type = "FILE",
                  .help = "The map that is taken as right",
                  .target = &given->reference,
                  .required = true}});
    command.add(
        "Comparison",
        {{"-o,--heat-map", "FILE", "PNG to write; white is a difference of 10 % of the mean",
          &given->heat_map, "A-vs-B.png beside A"},
         {"--ignore-above", "VALUE",
          "Leave out texels that are brighter than this in B, such as lamps in a picture",
          &given->most, "", positive()}});
    add_json_flag(command, given->json);
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

}  // namespace lumel
