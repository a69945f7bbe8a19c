// lumel info: what is in a scene and what a bake would take.

#include <fmt/core.h>

#include "commands.h"
#include "jobs/bake/bake.h"

namespace lumel {

int run(const InfoArguments& arguments)
{
    fmt::print("{}", describe(arguments.scene, arguments.options, arguments.json));
    return kExitDone;
}

}  // namespace lumel
