#include "jobs/bake/daylight.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/core/error.h"
#include "base/core/files.h"
#include "jobs/bake/advice.h"
#include "jobs/solve/host_memory.h"
#include "results/daylight/weather_notes.h"

namespace lumel {
namespace {

std::string name_of(const WeatherHour& hour)
{
    return fmt::format("{:02}-{:02}T{:02}", hour.month, hour.day, hour.ends - 1);
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

std::string WantedDaylight::name(std::size_t hour) const
{
    return name_of(weather_.hours[year_.number(hour)]);
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

std::optional<WantedDaylight> wanted_daylight(BakeOptions& options, Stages& stages)
{
    std::optional<WantedDaylight> wanted;
    if (!options.daylight.empty())
        wanted.emplace(options.daylight);
    options.atlas.daylit = wanted.has_value();
    if (wanted)
        for (const std::string& fault : weather_faults(wanted->weather()))
            stages.tell(fault);
    return wanted;
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

std::vector<Image> finish_daylight(const SolveScene& prepared, const DaylightMaps& maps,
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

std::vector<HourOfDaylight> hours_with_light(const WantedDaylight& wanted, const DaylightMaps& maps)
{
    const DaylightYear& year = wanted.year();
    const std::size_t count = maps.hours.size();
    std::vector<HourOfDaylight> hours;
    for (std::size_t h = 0; h < year.hours(); ++h)
        if (const DaylightYear::Sun& sun = year.sun(h); maps.mean[h] > 0.0 || sun.lux > 0.0f)
            hours.push_back({.name = wanted.name(h),
                             .sun = sun.direction,
                             .lux = sun.lux,
                             .mean = std::max(maps.mean[h], 0.0),
                             .error = maps.errors[h],
                             .weights = std::span(maps.weights).subspan(h * count, count)});
    std::ranges::sort(hours, {}, &HourOfDaylight::name);
    return hours;
}

}  // namespace lumel
