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
    command.add(
        {bake_argument(given->folder),
         {"other", "FOLDER", "A second bake, shown beside the first by a slider", &given->other}});
    command.add("Files", {{"-o,--output", "FILE", "HTML file to write", &given->page,
                           "report.html in the first folder"}});
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

}  // namespace lumel
