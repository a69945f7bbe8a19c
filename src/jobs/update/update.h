#pragma once
// lumel update: the maps of a finished bake, corrected for an edited scene.

#include <string>

#include "jobs/solve/bake_options.h"
#include "results/record/report.h"

namespace lumel {

struct UpdateOptions {
    LightOptions lights;       ///< none: those of the bake
    std::string device;        ///< index or part of a name as `lumel devices` lists; empty: best
    double residual = 0.01;    ///< error of the correction to stop at, as a part of all light
    int preview_width = 1280;  ///< [pixels], 0: no preview
};

struct UpdateSummary {
    UpdateRow row;
    double error = -1.0;   ///< estimated relative error of the map, < 0: not known
    double seconds = 0.0;  ///< in all
    bool interrupted = false;
    std::string report;  ///< the JSON of report.json
};

/// Finds what differs between the scene that was baked into `folder` and the one at `scene_path`,
/// and brings all files of the bake up to date with it; only report.json where nothing does. Throws
/// Error.
UpdateSummary update(const std::string& folder, const std::string& scene_path,
                     const UpdateOptions& options, const ProgressFunction& progress = {});

}  // namespace lumel
