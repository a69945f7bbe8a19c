#pragma once
// lumel measure: the light of a finished bake as a light meter shows it.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "jobs/solve/bake_options.h"
#include "results/measure/work_plane.h"

namespace lumel {

/// A point of --at, in the world.
struct MeasurePoint {
    glm::dvec3 place{0.0};             ///< [m]
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< of any length above 0
};

struct MeasureOptions {
    std::vector<MeasurePoint> points;
    std::optional<double> height;                 ///< of a work plane [m]
    double spacing = 0.0;                         ///< of its points [m], 0: 1/20 of its longer side
    std::optional<std::array<double, 4>> bounds;  ///< least x, z, most x, z [m]; else the scene's
    std::uint32_t samples = LightMeterOptions{}.samples;
    std::string table;    ///< CSV file to write, or empty
    std::string picture;  ///< PNG of the plane in false colours, or empty
    std::string preview;  ///< PNG of the scene in false colours, or empty
    int width = 1280;     ///< of that [pixels]
    std::string device;   ///< that draws it, as of BakeOptions
};

struct MeasureRow {
    MeasurePoint point;  ///< normal of unit length
    Reading reading;
};

struct MeasureSummary {
    std::vector<MeasureRow> rows;
    std::optional<WorkPlane> plane;
    PlaneFigures figures;            ///< of the plane
    std::optional<double> outdoors;  ///< under the overcast sky, which is the only light [lx]
    std::vector<std::string> notes;  ///< sentences for the user
    std::string report;              ///< JSON
};

/// Measures in a folder that lumel bake wrote, and writes the files of the options. Throws Error.
MeasureSummary measure(const std::string& folder, const MeasureOptions& options,
                       const ProgressFunction& progress = {});

}  // namespace lumel
