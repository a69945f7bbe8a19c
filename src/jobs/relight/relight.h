#pragma once
// lumel relight: the maps of a finished bake under other states of its lights.

#include <string>
#include <vector>

#include "base/json/json_view.h"
#include "jobs/solve/bake_options.h"

namespace lumel {

struct RelightOptions {
    std::string device;  ///< index or part of a name as `lumel devices` lists; empty: best
};

/// What a state has taken [s].
struct StateRow {
    std::string name;
    double light = 0.0;  ///< to find its light; states found together share it alike
    double files = 0.0;  ///< to finish its map and to write it
    double error = -1.0, dark_error = -1.0;  ///< of its map, as of SolverState; < 0: not known
};

/// As a report has them.
Json json_of(const std::vector<StateRow>& states);

struct RelightSummary {
    std::vector<StateRow> states;  ///< that were written
    double seconds = 0.0;          ///< in all
    bool interrupted = false;
    std::string report;  ///< JSON
};

/// Lights what `lumel bake` wrote with --keep-links, or --solver matrix, into `folder` anew, by the
/// file at `states` (see read_states()): states/NAME.exr, irradiance [lx], and states/NAME.png.
/// Throws Error.
RelightSummary relight(const std::string& folder, const std::string& states,
                       const RelightOptions& options, const ProgressFunction& progress = {});

}  // namespace lumel
