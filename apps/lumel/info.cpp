// lumel info: what is in a scene and what a bake would take.

#include <fmt/core.h>

#include "commands.h"

namespace lumel {

int run(const InfoArguments& arguments)
{
    std::string text = describe(arguments.scene, arguments.options, arguments.json);
    if (text.empty() || text.back() != '\n')
        text += '\n';
    fmt::print("{}", text);
    return kExitDone;
}

}  // namespace lumel
