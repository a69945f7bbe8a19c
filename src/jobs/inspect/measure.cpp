#include "jobs/inspect/measure.h"

#include <algorithm>
#include <array>
#include <fstream>

#include <fmt/format.h>

#include "base/core/files.h"
#include "base/core/parallel.h"
#include "base/core/usage.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "jobs/edit/finished_bake.h"
#include "jobs/inspect/measure_picture.h"
#include "jobs/solve/stages.h"
#include "results/daylight/weather_notes.h"
#include "results/files/folder.h"
#include "scene/sky/cie_sky.h"

namespace lumel {
namespace {

/// Points per progress report, and minimum per task.
constexpr std::size_t kPointsPerStep = 64, kPointsPerTask = 1;
/// Points along the longer side of a plane without --spacing.
constexpr double kPointsAlongPlane = 20.0;
constexpr double kPercent = 100.0;

/// The work plane, over the whole scene unless bounds are given.
WorkPlane plane_of(const MeasureOptions& options, const SolveScene& prepared)
{
    const glm::dvec3 low = prepared.low_in_file(), high = prepared.high_in_file();
    WorkPlane plane{.height = *options.height, .low = {low.x, low.z}, .high = {high.x, high.z}};
    if (const auto& bounds = options.bounds) {
        plane.low = {(*bounds)[0], (*bounds)[1]};
        plane.high = {(*bounds)[2], (*bounds)[3]};
    }
    const glm::dvec2 size = plane.high - plane.low;
    plane.spacing =
        options.spacing > 0.0 ? options.spacing : std::max(size.x, size.y) / kPointsAlongPlane;
    if (!(plane.spacing > 0.0))
        throw Error(ErrorKind::input, "--plane", "the scene has no surfaces; use --bounds");
    return plane;
}

/// Warns of a plane above, below or beside all surfaces: a slip of units or axes.
void warn_if_outside(const WorkPlane& plane, const SolveScene& prepared, Stages& stages)
{
    const glm::dvec3 low = prepared.low_in_file(), high = prepared.high_in_file();
    if (!is_near_scene(plane.height, low.y, high.y) || plane.high.x < low.x ||
        plane.low.x > high.x || plane.high.y < low.z || plane.low.y > high.z)
        stages.warn(
            fmt::format("the plane is outside of the scene, which reaches from {:.4g},{:.4g},"
                        "{:.4g} to {:.4g},{:.4g},{:.4g} m",
                        low.x, low.y, low.z, high.x, high.y, high.z));
}

MeterPoint meter_point(const FinishedBake& bake, const MeasurePoint& point)
{
    return {glm::vec3(point.place - bake.prepared.scene.origin),
            glm::normalize(glm::vec3(point.normal))};
}

void read_all(const FinishedBake& bake, const LightMeter& meter, std::vector<MeasureRow>& rows,
              Stages& stages)
{
    const bool done = parallel_steps(
        rows.size(), kPointsPerStep, kPointsPerTask,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                MeasurePoint& point = rows[i].point;
                point.normal = glm::normalize(point.normal);
                rows[i].reading = meter.read(meter_point(bake, point), std::uint32_t(i));
            }
        },
        [&](std::size_t count) { return stages.progress(double(count) / double(rows.size())); });
    if (!done)
        throw_stopped();
}

/// Index of an hour in the year. Throws Error{input} if it has no such hour.
std::size_t hour_of(const Weather& weather, const DaylightYear& year, const HourOfYear& wanted)
{
    for (std::size_t h = 0; h < year.hours(); ++h) {
        const WeatherHour& hour = weather.hours[year.number(h)];
        if (hour.month == wanted.month && hour.day == wanted.day && hour.ends == wanted.begins + 1)
            return h;
    }
    throw Error(ErrorKind::input, "--hour",
                fmt::format("the weather file has no {:02}-{:02}T{:02} within the occupied hours; "
                            "see --hours",
                            wanted.month, wanted.day, wanted.begins));
}

/// The hours of a year, and what the lumels of a bake reflect in them.
struct Daylight {
    DaylightYear year;
    std::optional<std::size_t> hour;  ///< that is measured too
    ReflectedDaylight reflected;
};

std::uint32_t seed_in(const FinishedBake& bake)
{
    return std::uint32_t(seed_of(bake.record.solver.method));
}

/// Throws Error{input} if the year lacks the hour, or memory is short.
Daylight find_daylight(const FinishedBake& bake, const Weather& weather,
                       const DaylightOptions& options, Stages& stages)
{
    stages.begin("sky and sun");
    DaylightYear year(weather, options.occupied);
    std::optional<std::size_t> one;
    if (options.hour)
        one = hour_of(weather, year, *options.hour);
    stages.note(fmt::format("{} patches of the sky, {} positions of the sun", SkyPatches().count(),
                            year.sun_places().size()));
    stages.begin("daylight");
    const std::uint64_t free = available_memory_bytes(),
                        needed = lumel_coefficient_bytes(bake.prepared.lumels.lumels.size(),
                                                         year.sun_places().size());
    if (free > 0 && needed > free)
        throw Error(ErrorKind::input, "--weather",
                    "needs about " + memory_text(needed) +
                        " of memory for this bake; bake the scene with a smaller --size");
    ReflectedDaylight reflected(bake.prepared, year.sun_places(), {.seed = seed_in(bake)},
                                stages.callback());
    return {std::move(year), one, std::move(reflected)};
}

/// Measures daylight over the year of the weather file.
void read_year(const FinishedBake& bake, const LightMeter& meter, const Weather& weather,
               const Daylight& daylight, const DaylightOptions& options, MeasureSummary& summary,
               Stages& stages)
{
    stages.begin("hours");
    const DaylightMeter hours(meter, daylight.year, daylight.reflected, seed_in(bake));
    std::vector<MeasureRow>& rows = summary.rows;
    const bool done = parallel_steps(
        rows.size(), kPointsPerStep, kPointsPerTask,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                rows[i].daylight = hours.read(meter_point(bake, rows[i].point), std::uint32_t(i),
                                              options.target, daylight.hour);
        },
        [&](std::size_t count) { return stages.progress(double(count) / double(rows.size())); });
    if (!done)
        throw_stopped();
    std::vector<DaylightReading> readings;
    for (const MeasureRow& row : rows)
        readings.push_back(*row.daylight);
    summary.year = {.city = weather.city,
                    .hours = daylight.year.hours(),
                    .target = options.target,
                    .figures = figures_of(readings)};
    summary.notes.push_back(weather_summary(weather, daylight.year, options.occupied));
    if (bake.record.lights.ground > 0.0f)
        summary.notes.emplace_back("--ground does not count over the year");
    for (std::string& note : weather_faults(weather))
        summary.notes.push_back(std::move(note));
}

/// Illuminance of an open plane, if an overcast sky is the only light.
std::optional<double> outdoors(const FinishedBake& bake, const LightMeter& meter,
                               MeasureSummary& summary)
{
    const LightOptions& lights = bake.record.lights;
    if (!lights.cie || !is_overcast(lights.cie->type))
        return std::nullopt;
    if (meter.has_lamps()) {
        summary.notes.emplace_back(
            "no daylight factors: the bake has other lights than the overcast sky");
        return std::nullopt;
    }
    return double(lights.cie->lux) * double(lights.sky_scale);
}

/// Ranges of useful daylight illuminance, as in JSON.
constexpr std::array<const char*, 4> kUsefulNames = {"below_100", "100_to_300", "300_to_3000",
                                                     "above_3000"};

Json json_of(const DaylightReading& daylight)
{
    Json useful;
    for (std::size_t k = 0; k < kUsefulNames.size(); ++k)
        useful[kUsefulNames[k]] = kPercent * daylight.useful[k];
    Json json = {{"factor_noise", kPercent * daylight.factor_noise},
                 {"autonomy", kPercent * daylight.autonomy},
                 {"useful", useful},
                 {"mean_illuminance", daylight.mean_lux},
                 {"outdoors", daylight.is_outdoors()}};
    if (daylight.hour)
        json["hour"] = {{"illuminance", daylight.hour->lux},
                        {"noise", daylight.hour->noise},
                        {"interpolation", daylight.hour->interpolation}};
    return json;
}

Json json_of(const MeasureSummary& summary, const MeasureRow& row)
{
    Json json = {{"place", json_array(row.point.place)},
                 {"normal", json_array(row.point.normal)},
                 {"inside", row.reading.inside}};
    if (row.reading.inside)
        return json;
    json["illuminance"] = row.reading.lux;
    json["noise"] = row.reading.noise;
    json["light"] = json_array(glm::dvec3(row.reading.light));
    if (const auto factor = daylight_factor(summary, row))
        json["daylight_factor"] = kPercent * *factor;
    if (row.daylight)
        json["year"] = json_of(*row.daylight);
    return json;
}

Json json_of(const WorkPlane& plane, const MeasureSummary& summary)
{
    const PlaneFigures& figures = summary.figures;
    Json json = {{"height", plane.height},
                 {"spacing", plane.spacing},
                 {"bounds", {plane.low.x, plane.low.y, plane.high.x, plane.high.y}},
                 {"points", figures.count},
                 {"left_out", summary.rows.size() - figures.count}};
    if (figures.count == 0)
        return json;
    json["minimum"] = figures.least;
    json["mean"] = figures.mean;
    json["maximum"] = figures.most;
    json["uniformity"] = figures.uniformity;
    json["noise_of_mean"] = figures.noise_of_mean;
    if (summary.outdoors)
        json["mean_daylight_factor"] = kPercent * figures.mean / *summary.outdoors;
    if (!summary.year)
        return json;
    const DaylightFigures& year = summary.year->figures;
    json["left_out_outdoors"] = year.outdoors;
    if (year.count > 0) {
        json["mean_daylight_factor"] = kPercent * year.factor;
        json["sufficient_daylight"] = kPercent * year.sufficient;
        json["mean_useful_daylight"] = kPercent * year.useful;
    }
    return json;
}

std::string report_of(const FinishedBake& bake, const MeasureSummary& summary)
{
    Json json;
    json["units"] = {{"place", "m"},
                     {"illuminance", "lx"},
                     {"light", "lx, linear RGB"},
                     {"noise", "lx, standard error of the rays"},
                     {"daylight_factor", "%"},
                     {"autonomy", "% of the hours"},
                     {"useful", "% of the hours"},
                     {"sufficient_daylight", "% of the points"}};
    if (bake.record.error >= 0.0)
        json["error_of_bake"] = bake.record.error;
    if (summary.outdoors)
        json["outdoors"] = *summary.outdoors;
    if (summary.plane)
        json["plane"] = json_of(*summary.plane, summary);
    if (summary.year)
        json["year"] = {{"city", summary.year->city},
                        {"hours", summary.year->hours},
                        {"target", summary.year->target}};
    json["points"] = Json::array();
    for (const MeasureRow& row : summary.rows)
        json["points"].push_back(json_of(summary, row));
    json["notes"] = summary.notes;
    return json_text(json);
}

std::string csv_of(const MeasureSummary& summary)
{
    std::string text = "x_m,y_m,z_m,normal_x,normal_y,normal_z,illuminance_lx,noise_lx";
    const bool has_factor = summary.outdoors || summary.year;
    if (has_factor)
        text += ",daylight_factor_percent";
    if (summary.year) {
        text += ",autonomy_percent";
        for (const char* name : kUsefulNames)
            text += fmt::format(",useful_{}_percent", name);
        text += ",mean_daylight_lx";
        if (!summary.rows.empty() && summary.rows.front().daylight->hour)
            text += ",hour_lx,hour_noise_lx,hour_interpolation_lx";
    }
    text += "\n";
    for (const MeasureRow& row : summary.rows) {
        const glm::dvec3 &at = row.point.place, &n = row.point.normal;
        text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},", at.x, at.y, at.z, n.x,
                            n.y, n.z);
        const Reading& reading = row.reading;
        text += reading.inside ? "," : fmt::format("{:.6g},{:.3g}", reading.lux, reading.noise);
        const auto add = [&](double value) {
            text += reading.inside ? "," : fmt::format(",{:.6g}", value);
        };
        if (has_factor)
            add(kPercent * *daylight_factor(summary, row));
        if (row.daylight) {
            add(kPercent * row.daylight->autonomy);
            for (const double share : row.daylight->useful)
                add(kPercent * share);
            add(row.daylight->mean_lux);
            if (row.daylight->hour) {
                add(row.daylight->hour->lux);
                add(row.daylight->hour->noise);
                add(row.daylight->hour->interpolation);
            }
        }
        text += "\n";
    }
    return text;
}

void write_csv(const std::string& path, const MeasureSummary& summary)
{
    OutputFile output(path);
    std::ofstream file(output.path(), std::ios::binary);
    file << csv_of(summary);
    file.close();
    if (!file)
        throw Error(ErrorKind::output, path, "cannot be written");
    output.commit();
}

void write_drawn(const std::string& path, const Image& picture)
{
    OutputFile output(path);
    write_png(output.path(), picture);
    output.commit();
}

void write_preview(const FinishedBake& bake, const MeasureOptions& options)
{
    const gpu::Device device(options.device);
    const Image picture = preview_picture(device, bake.prepared, bake.irradiance, options.width);
    device.check_validation();
    write_drawn(options.preview, picture);
}

}  // namespace

std::optional<double> daylight_factor(const MeasureSummary& summary, const MeasureRow& row)
{
    if (row.daylight)
        return row.daylight->factor;
    if (summary.outdoors)
        return row.reading.lux / *summary.outdoors;
    return std::nullopt;
}

MeasureSummary measure(const std::string& folder, const MeasureOptions& options,
                       const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    // Before the long work, which a file at fault would lose.
    std::optional<Weather> weather;
    if (const std::string& file = options.daylight.weather; !file.empty())
        weather = read_weather(read_file(file, file), file);
    const FinishedBake bake(folder);
    MeasureSummary summary;
    for (const MeasurePoint& point : options.points)
        summary.rows.push_back({.point = point});
    PlaneGrid grid;
    if (options.height) {
        summary.plane = plane_of(options, bake.prepared);
        grid = points_on(*summary.plane);
        warn_if_outside(*summary.plane, bake.prepared, stages);
        for (const glm::dvec3& place : grid.points)
            summary.rows.push_back({.point = {.place = place}});
    }

    // Before the plane is traced, which a refused hour would lose.
    std::optional<Daylight> daylight;
    if (weather)
        daylight.emplace(find_daylight(bake, *weather, options.daylight, stages));

    stages.begin("rays");
    const LightMeter meter(
        bake.prepared.scene, bake.prepared.rays, bake.prepared.atlas, bake.prepared.lumels,
        bake.irradiance, {.samples = options.samples, .seed = seed_of(bake.record.solver.method)});
    read_all(bake, meter, summary.rows, stages);
    if (!weather)
        summary.outdoors = outdoors(bake, meter, summary);
    std::vector<Reading> readings;
    for (const MeasureRow& row : summary.rows)
        readings.push_back(row.reading);
    summary.figures = figures_of(readings);
    if (weather)
        read_year(bake, meter, *weather, *daylight, options.daylight, summary, stages);
    summary.report = report_of(bake, summary);

    stages.begin("writing");
    if (!options.table.empty())
        write_csv(options.table, summary);
    if (!options.picture.empty())
        write_drawn(options.picture, plane_picture(grid, readings));
    if (!options.preview.empty())
        write_preview(bake, options);
    stages.end();
    return summary;
}

}  // namespace lumel
