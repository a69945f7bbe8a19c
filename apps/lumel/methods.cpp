// lumel methods: the solvers, as their table lists them. And the texts of --help and --version.

#include <fmt/core.h>

#include "commands.h"
#include "methods/methods.h"

namespace lumel {

int run(const MethodsArguments&)
{
    for (const MethodInfo& method : methods())
        fmt::print("{}  {} {}\n    use it for: {}\n", method.id, method.title, method.paper,
                   method.advice);
    return kExitDone;
}

int run(const TextArguments& arguments)
{
    fmt::print("{}", arguments.text);
    return kExitDone;
}

}  // namespace lumel
