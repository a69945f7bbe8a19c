// The options of the commands that list what there is: devices, methods.

#include <memory>

#include <CLI/CLI.hpp>

#include "command.h"
#include "shared_options.h"

namespace lumel {

Command devices_command(CLI::App& program)
{
    const auto given = std::make_shared<DevicesArguments>();
    CLI::App& command =
        *program.add_subcommand("devices", "List the Vulkan devices, and why one cannot be used");
    add_json_flag(command, given->json);
    return {&command, [given]() -> Arguments { return *given; }};
}

Command methods_command(CLI::App& program)
{
    return {program.add_subcommand("methods", "List the methods of --solver"),
            []() -> Arguments { return MethodsArguments{}; }};
}

}  // namespace lumel
