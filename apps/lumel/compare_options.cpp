// The options of lumel compare.

#include <memory>

#include "option_values.h"
#include "shared_options.h"

namespace lumel {

Command compare_command()
{
    const auto given = std::make_shared<CompareArguments>();
    Command command{.name = "compare", .help = "Measure the difference between map A and map B"};
    command.add({{.names = "A",
                  .type = "FILE",
                  .help = "Map to measure, an EXR file",
                  .target = &given->map,
                  .required = true},
                 {.names = "B",
                  .type = "FILE",
                  .help = "Reference map, an EXR file",
                  .target = &given->reference,
                  .required = true}});
    command.add("Comparison",
                {{"-o,--heat-map", "FILE",
                  "Heat map to write, a PNG; white is a difference of 10 % of the mean",
                  &given->heat_map, "A-vs-B.png beside A"},
                 {"--ignore-above", "VALUE",
                  "Leave out texels brighter than this in B, such as lamps in an image",
                  &given->most, "", positive()}});
    add_json_flag(command, given->json);
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

}  // namespace lumel
