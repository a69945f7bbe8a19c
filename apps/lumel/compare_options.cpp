// The options of lumel compare.

#include <memory>

#include <CLI/CLI.hpp>

#include "command.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {

Command compare_command(CLI::App& program)
{
    const auto given = std::make_shared<CompareArguments>();
    CompareArguments& compare = *given;
    CLI::App& command = *program.add_subcommand("compare", "Measure how far map A is from map B");
    command.option_defaults()->group("Comparison");
    command.add_option("A", compare.map, "The map to measure, an EXR file")
        ->required()
        ->type_name("FILE");
    command.add_option("B", compare.reference, "The map that is taken as right")
        ->required()
        ->type_name("FILE");
    command
        .add_option("-o,--heat-map", compare.heat_map,
                    "PNG to write; white is a difference of 10 % of the mean")
        ->type_name("FILE")
        ->default_str("A-vs-B.png beside A");
    command
        .add_option("--ignore-above", compare.most,
                    "Leave out texels that are brighter than this in B, such as lamps in a picture")
        ->type_name("VALUE")
        ->check(positive());
    add_json_flag(command, compare.json);
    return {&command, [given]() -> Arguments { return *given; }};
}

}  // namespace lumel
