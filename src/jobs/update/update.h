#pragma once
// lumel update: corrects the maps of a finished bake for an edited scene.

#include <string>

#include "jobs/solve/bake_options.h"
#include "results/record/report.h"

namespace lumel {

struct UpdateOptions {
    LightOptions lights;       ///< default: those of the bake
    std::string device;        ///< index or part of a name as `lumel devices` lists; empty: best
    double residual = 0.01;    ///< target error of the correction relative to all light
    int preview_width = 1280;  ///< [pixels], 0: no preview
};

struct UpdateSummary {
    UpdateRow row;
    double error = -1.0;      ///< estimated relative error of the map, < 0: unknown
    double eye_error = -1.0;  ///< the same relative to the light around each lumel
    double seconds = 0.0;     ///< total
    bool interrupted = false;
    std::string report;  ///< JSON of report.json
};

/// Finds the differences between the scene baked into `folder` and the one at `scene_path`, and
/// updates all files of the bake; only report.json if there are none. Throws Error.
UpdateSummary update(const std::string& folder, const std::string& scene_path,
                     const UpdateOptions& options, const ProgressFunction& progress = {});

}  // namespace lumel
