// The options of the commands that list what there is: devices, methods.

#include <memory>

#include "shared_options.h"

namespace lumel {

Command devices_command()
{
    const auto given = std::make_shared<DevicesArguments>();
    Command command{.name = "devices",
                    .help = "List the Vulkan devices, and the reason if one is unusable"};
    add_json_flag(command, given->json);
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

Command methods_command()
{
    return {.name = "methods",
            .help = "List the methods of --solver",
            .arguments = [](const Command&) -> Arguments { return {MethodsArguments{}}; }};
}

}  // namespace lumel
