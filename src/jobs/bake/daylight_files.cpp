#include "jobs/bake/daylight_files.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "atlas/finish/finish.h"
#include "base/core/error.h"
#include "base/core/files.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "jobs/bake/advice.h"
#include "jobs/bake/outputs.h"
#include "jobs/solve/host_memory.h"
#include "results/daylight/weather_notes.h"
#include "results/page/daylight_list.h"
#include "results/record/bake_record.h"

namespace lumel {
namespace {

static_assert(kMostDaylightMaps <= kMaxDaylightMaps, "pages read as many");

constexpr OccupiedHours kWholeDay{0, 24};

/// "06-21T12": the hour from 12 to 13 o'clock on 21 June.
std::string name_of(const WeatherHour& hour)
{
    return fmt::format("{:02}-{:02}T{:02}", hour.month, hour.day, hour.ends - 1);
}

/// Finished maps [K] of the light of the hours, none negative.
std::vector<Image> finished(const SolveScene& prepared, const DaylightMaps& maps,
                            const std::vector<glm::vec3>& irradiance)
{
    Estimates sum(prepared.lumels.lumels.size(), glm::vec3(0.0f));
    for (const Estimates& light : maps.light)
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += light[i];
    FinishedMaps found = finish_maps(prepared.scene, prepared.atlas, prepared.lumels,
                                     is_lit(irradiance) ? irradiance : sum, maps.light);
    for (Image& map : found.layers)
        for (float& value : map.values)
            value = std::max(value, 0.0f);
    return std::move(found.layers);
}

/// Rounded to what daylight.json keeps.
double digits(double value)
{
    return std::stod(fmt::format("{:.5g}", value));
}

/// In the order of the calendar: a year of weather may begin in any month.
Json hours_of(const WantedDaylight& wanted, const DaylightMaps& maps)
{
    const DaylightYear& year = wanted.year();
    const std::size_t count = maps.hours.size();
    Json rows = Json::array();
    for (std::size_t h = 0; h < year.hours(); ++h) {
        const DaylightYear::Sun& sun = year.sun(h);
        if (!(maps.mean[h] > 0.0) && !(sun.lux > 0.0f))
            continue;
        Json weights = Json::array();
        for (std::size_t k = 0; k < count; ++k)
            weights.push_back(digits(double(maps.weights[h * count + k])));
        Json direction = Json::array();
        for (int axis = 0; axis < 3; ++axis)
            direction.push_back(digits(double(sun.direction[axis])));
        rows.push_back({{"hour", name_of(wanted.weather().hours[year.number(h)])},
                        {"sun", direction},
                        {"lux", digits(double(sun.lux))},
                        {"mean", digits(std::max(maps.mean[h], 0.0))},
                        {"error", digits(maps.errors[h])},
                        {"weights", weights}});
    }
    std::sort(rows.begin(), rows.end(), [](const Json& one, const Json& other) {
        return one["hour"].get<std::string>() < other["hour"].get<std::string>();
    });
    return rows;
}

}  // namespace

WantedDaylight::WantedDaylight(const std::string& weather_file)
    : weather_(read_weather(read_file(weather_file, weather_file), weather_file)),
      year_(weather_, kWholeDay)
{
    std::set<std::string> names;
    for (const WeatherHour& hour : weather_.hours)
        if (const std::string name = name_of(hour); !names.insert(name).second)
            throw Error(ErrorKind::input, weather_file,
                        "has the hour " + name + " twice, but --daylight needs a calendar year");
}

void WantedDaylight::check_memory(const SolveScene& prepared, const BakeOptions& options,
                                  std::uint64_t limit) const
{
    const HostMemory own = host_memory(prepared, options, false);
    const std::uint64_t needed =
        daylight_map_bytes(prepared, year_.sun_places().size(), own.scene + own.trees + own.atlas);
    if (limit > 0 && needed > limit)
        throw Error(ErrorKind::input, "--daylight",
                    fmt::format("needs about {} for this bake, but there is {}; choose a smaller "
                                "--size",
                                memory_text(needed), memory_text(limit)));
}

std::optional<DaylightMaps> make_daylight_maps(const WantedDaylight& wanted,
                                               const SolveScene& prepared,
                                               const AtlasOptions& options, std::uint32_t seed,
                                               Stages& stages)
{
    stages.begin("daylight");
    DaylightMaps maps;
    try {
        if (!unless_stopped([&] {
                maps = daylight_maps(prepared, options, wanted.year(), seed, stages.callback());
            })) {
            stages.tell("the bake was stopped before the maps of daylight were made");
            return std::nullopt;
        }
    } catch (const Error& error) {
        // The bake is not lost.
        stages.warn(std::string("no maps of daylight: ") + error.what());
        return std::nullopt;
    }
    if (maps.hours.empty()) {
        stages.warn("no daylight reaches any surface: there are no maps of it");
        return std::nullopt;
    }
    if (maps.error > kMapsError)
        stages.warn(fmt::format("{} maps of daylight, the most there are, leave an error of {}",
                                maps.hours.size(), percent_text(maps.error)));
    return maps;
}

std::vector<std::string> write_daylight(const OutputFolder& folder, const BakeOptions& options,
                                        const SolveScene& prepared, const WantedDaylight& wanted,
                                        const DaylightMaps& maps,
                                        const std::vector<glm::vec3>& irradiance, Stages& stages)
{
    const Weather& weather = wanted.weather();
    const Pages& pages = prepared.atlas.pages;
    const std::vector<Image> images = finished(prepared, maps, irradiance);
    std::vector<std::string> files;
    Json rows = Json::array();
    for (std::size_t k = 0; k < images.size(); ++k) {
        const std::string hour = name_of(weather.hours[wanted.year().number(maps.hours[k])]);
        const std::string name = kDaylightPrefix + hour;
        for (int page = 0; page < pages.count; ++page) {
            files.push_back(page_name(pages, page, name) + ".exr");
            write_exr(folder.path(files.back()), cut_page(pages, page, images[k]),
                      options.half ? Precision::float16 : Precision::float32,
                      map_metadata(prepared.scene));
        }
        rows.push_back(
            {{"hour", hour}, {"unit", "lx"}, {"map", page_name(pages, 0, name) + ".exr"}});
    }
    write_compact_json(folder.path(kDaylightFile),
                       {{"place",
                         {{"name", weather.city},
                          {"latitude", glm::degrees(weather.latitude)},
                          {"longitude", glm::degrees(weather.longitude)}}},
                        {"error", maps.error},
                        {"maps", rows},
                        {"hours", hours_of(wanted, maps)}});
    files.emplace_back(kDaylightFile);
    stages.tell(fmt::format("{} maps of daylight; their sums are that of all hours of the year "
                            "within {}, but for direct light of the sun",
                            images.size(), percent_text(maps.error)));
    for (const std::string& note : weather_notes(weather, wanted.year(), kWholeDay))
        stages.tell(note);
    return files;
}

}  // namespace lumel
