#include "jobs/bake/daylight_files.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "atlas/finish/finish.h"
#include "base/core/files.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "jobs/bake/lamp_maps.h"
#include "jobs/bake/outputs.h"
#include "results/daylight/weather_notes.h"
#include "results/record/bake_record.h"

namespace lumel {
namespace {

constexpr OccupiedHours kWholeDay{0, 24};

/// "06-21T12": the hour from 12 to 13 o'clock on 21 June.
std::string name_of(const WeatherHour& hour)
{
    return fmt::format("{:02}-{:02}T{:02}", hour.month, hour.day, hour.ends - 1);
}

/// Finished maps [K] of the light of the hours, none negative.
std::vector<Image> finished(const SolveScene& prepared, const DaylightMaps& maps)
{
    Estimates sum(prepared.lumels.lumels.size(), glm::vec3(0.0f));
    for (const Estimates& light : maps.light)
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += light[i];
    FinishedMaps found =
        finish_maps(prepared.scene, prepared.atlas, prepared.lumels, sum, maps.light);
    for (Image& map : found.layers)
        for (float& value : map.values)
            value = std::max(value, 0.0f);
    return std::move(found.layers);
}

DaylightTransportOptions options_of(std::uint32_t seed, std::size_t lumels)
{
    // Means of many lumels decide on the hours: the more there are, the fewer rays each needs.
    constexpr std::size_t kRaysOfAll = 3'000'000;
    DaylightTransportOptions options{.seed = seed, .asked_by = "--daylight"};
    for (std::uint32_t* rays : {&options.sky_rays, &options.link_rays})
        for (int halvings = 0; halvings < 2 && *rays * lumels > kRaysOfAll; ++halvings)
            *rays /= 2;
    return options;
}

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
            weights.push_back(shortest(maps.weights[h * count + k]));
        rows.push_back({{"hour", name_of(wanted.weather().hours[year.number(h)])},
                        {"sun", json_array(glm::dvec3(sun.direction))},
                        {"lux", shortest(sun.lux)},
                        {"mean", shortest(float(maps.mean[h]))},
                        {"error", shortest(float(maps.errors[h]))},
                        {"weights", weights}});
    }
    return rows;
}

}  // namespace

WantedDaylight::WantedDaylight(const std::string& weather_file)
    : weather_(read_weather(read_file(weather_file, weather_file), weather_file)),
      year_(weather_, kWholeDay)
{
}

void WantedDaylight::check_memory(std::size_t lumels) const
{
    DaylightTransport::check_memory(lumels, year_.sun_places().size(), options_of(1, lumels));
}

std::optional<DaylightMaps> make_daylight_maps(const WantedDaylight& wanted,
                                               const SolveScene& prepared, std::uint32_t seed,
                                               Stages& stages)
{
    stages.begin("daylight");
    std::optional<DaylightMaps> maps;
    if (!stages.stopped())
        maps =
            daylight_maps(prepared, wanted.year(), options_of(seed, prepared.lumels.lumels.size()),
                          [&](double part) { return stages.progress(part); });
    if (!maps)
        stages.tell("the bake was stopped before the maps of daylight were made; --resume makes "
                    "them");
    else if (maps->hours.empty()) {
        stages.warn("no daylight reaches any surface: there are no maps of it");
        maps.reset();
    }
    return maps;
}

std::vector<std::string> write_daylight(const OutputFolder& folder, const BakeOptions& options,
                                        const SolveScene& prepared, const WantedDaylight& wanted,
                                        const DaylightMaps& maps, Stages& stages)
{
    const Weather& weather = wanted.weather();
    const Pages& pages = prepared.atlas.pages;
    const std::vector<Image> images = finished(prepared, maps);
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
    write_json(folder.path(kDaylightFile), {{"place",
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
