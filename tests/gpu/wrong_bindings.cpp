// Calls of a kernel that must not compile, but for the first: wrong_bindings.cmake tries each by
// defining WRONG.

#include "gpu/commands.h"
#include "tests/gpu/weigh.comp.h"

namespace lumel::gpu {

void call(Commands& commands, const Kernel<shaders::Weigh>& weigh, const Array<float>& weights,
          const Array<Colored>& values, const Array<glm::vec3>& result)
{
#ifndef WRONG
    commands.dispatch(weigh, {.weights = weights, .values = values, .result = result}, {1}, 1);
#elif WRONG == 1  // two arrays swapped
    commands.dispatch(weigh, {.weights = weights, .values = result, .result = values}, {1}, 1);
#elif WRONG == 2  // one forgotten
    commands.dispatch(weigh, {.weights = weights, .result = result}, {1}, 1);
#elif WRONG == 3  // a name misspelt
    commands.dispatch(weigh, {.weight = weights, .values = values, .result = result}, {1}, 1);
#elif WRONG == 4  // other parameters
    commands.dispatch(weigh, {.weights = weights, .values = values, .result = result},
                      shaders::Weigh::Bindings{weights, values, result}, 1);
#elif WRONG == 5  // what no one reads
    commands.dispatch(weigh,
                      {.nothing = weights, .weights = weights, .values = values, .result = result},
                      {1}, 1);
#endif
}

}  // namespace lumel::gpu
