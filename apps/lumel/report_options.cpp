// The options of lumel report.

#include <memory>

#include <CLI/CLI.hpp>

#include "command.h"

namespace lumel {

Command report_command(CLI::App& program)
{
    const auto given = std::make_shared<ReportArguments>();
    ReportArguments& report = *given;
    CLI::App& command = *program.add_subcommand(
        "report", "Write a page to walk through a bake and read its light, or to compare two");
    command.add_option("folder", report.folder, "What lumel bake wrote")
        ->required()
        ->type_name("FOLDER");
    command.add_option("other", report.other, "A second bake, shown beside the first by a slider")
        ->type_name("FOLDER");
    command.option_defaults()->group("Files");
    command.add_option("-o,--output", report.page, "HTML file to write")
        ->type_name("FILE")
        ->default_str("report.html in the first folder");
    return {&command, [given]() -> Arguments { return *given; }};
}

}  // namespace lumel
