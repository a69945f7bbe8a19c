#pragma once
// The options of methods on the command line, as the table of methods describes them.

#include "solve/methods.h"

namespace CLI {
class App;
}

namespace lumel {

/// --solver, and the options of all methods.
void add_methods(CLI::App& app, GivenMethod& given);

/// The options of the one method that `given` names.
void add_one_method(CLI::App& app, GivenMethod& given);

}  // namespace lumel
