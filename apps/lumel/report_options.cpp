// The options of lumel report.

#include <memory>

#include "shared_options.h"

namespace lumel {

Command report_command()
{
    const auto given = std::make_shared<ReportArguments>();
    Command command{
        .name = "report",
        .help = "Write a page to walk through a bake and read its light, or to compare two"};
    command.add({bake_argument(given->folder),
                 {.names = "other",
                  .type = "FOLDER",
                  .help = "A second bake, shown beside the first by a slider",
                  .target = &given->other}});
    command.add("Files", {{.names = "-o,--output",
                           .type = "FILE",
                           .help = "HTML file to write",
                           .default_value = "report.html in the first folder",
                           .target = &given->page}});
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

}  // namespace lumel
