#pragma once
// lumel measure: illuminance in a finished bake, as by a light meter.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "jobs/solve/bake_options.h"
#include "results/daylight/daylight_meter.h"
#include "results/measure/work_plane.h"

namespace lumel {

/// A point of --at, world space.
struct MeasurePoint {
    glm::dvec3 place{0.0};             ///< [m]
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< any length above 0
};

/// An hour of local standard time.
struct HourOfYear {
    int month = 1, day = 1;
    int begins = 0;  ///< 0 to 23
};

/// Daylight over a year.
struct DaylightOptions {
    std::string weather;             ///< EPW file, or empty: none
    OccupiedHours occupied;          ///< that count
    double target = 300.0;           ///< illuminance [lx] of daylight autonomy
    std::optional<HourOfYear> hour;  ///< that is measured too
};

struct MeasureOptions {
    std::vector<MeasurePoint> points;
    std::optional<double> height;                 ///< height of a work plane [m]
    double spacing = 0.0;                         ///< spacing [m], 0: 1/20 of its longer side
    std::optional<std::array<double, 4>> bounds;  ///< min x, z, max x, z [m]; default: the scene's
    std::uint32_t samples = LightMeterOptions{}.samples;
    DaylightOptions daylight;
    std::string table;    ///< CSV file to write, or empty
    std::string picture;  ///< PNG of the plane in false colours, or empty
    std::string preview;  ///< PNG of the scene in false colours, or empty
    int width = 1280;     ///< width of the preview [pixels]
    std::string device;   ///< device that renders it, see BakeOptions
};

struct MeasureRow {
    MeasurePoint point;  ///< with unit normal
    Reading reading;
    std::optional<DaylightReading> daylight = {};  ///< with a weather file
};

/// The year of a weather file.
struct MeasuredYear {
    std::string city;
    std::size_t hours = 0;    ///< that count
    double target = 0.0;      ///< [lx]
    DaylightFigures figures;  ///< over the plane
};

struct MeasureSummary {
    std::vector<MeasureRow> rows;
    std::optional<WorkPlane> plane;
    PlaneFigures figures;            ///< over the plane
    std::optional<double> outdoors;  ///< under an overcast sky, if it is the only light [lx]
    std::optional<MeasuredYear> year;
    std::vector<std::string> notes;  ///< sentences for the user
    std::string report;              ///< JSON
};

/// Daylight factor of a row, 0…1: by the year, else by the bake; nothing if there is none.
std::optional<double> daylight_factor(const MeasureSummary& summary, const MeasureRow& row);

/// Measures in the folder of a bake, and writes the files of the options. Throws Error.
MeasureSummary measure(const std::string& folder, const MeasureOptions& options,
                       const ProgressFunction& progress = {});

}  // namespace lumel
