#pragma once
// lumel relight: maps of a finished bake with other light states.

#include <string>
#include <vector>

#include "base/json/json_view.h"
#include "jobs/solve/bake_options.h"

namespace lumel {

struct RelightOptions {
    std::string device;  ///< index or part of a name as `lumel devices` lists; empty: best
};

/// Cost and error of a state.
struct StateRow {
    std::string name;
    double light = 0.0;  ///< to light it [s]; states lit together share the time equally
    double files = 0.0;  ///< to finish and write its map [s]
    /// As in SolverState; < 0: unknown.
    double error = -1.0, dark_error = -1.0, eye_error = -1.0;
};

/// For the report.
Json json_of(const std::vector<StateRow>& states);

struct RelightSummary {
    std::vector<StateRow> states;  ///< those written
    double seconds = 0.0;          ///< total
    bool interrupted = false;
    std::string report;  ///< JSON
};

/// Relights the bake in `folder`, made with --keep-links or --solver matrix, by the file `states`
/// (see read_states()): writes states/NAME.exr, irradiance [lx], and states/NAME.png. Throws Error.
RelightSummary relight(const std::string& folder, const std::string& states,
                       const RelightOptions& options, const ProgressFunction& progress = {});

}  // namespace lumel
