#pragma once
// Options of a solver in a report.

#include "base/json/json_view.h"
#include "methods/methods.h"

namespace lumel {

/// {"method": id, "limits": {"shots": …, "seconds": …, "error": …}, "options": {…}}.
/// Options are named as on the command line.
Json solver_settings(const SolverOptions& options);

/// Inverse of solver_settings(). Throws Error{input} with the location of the error.
SolverOptions solver_options_of(const JsonView& settings);

}  // namespace lumel
