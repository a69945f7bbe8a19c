#include "jobs/bake/daylight_files.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "jobs/bake/outputs.h"
#include "results/daylight/weather_notes.h"
#include "results/page/daylight_list.h"
#include "results/record/bake_record.h"

namespace lumel {
namespace {

static_assert(kMostDaylightMaps <= kMaxDaylightMaps, "pages read as many");

/// Rounded to what daylight.json keeps.
double digits(double value)
{
    return std::stod(fmt::format("{:.5g}", value));
}

Json json_of(const HourOfDaylight& hour)
{
    Json weights = Json::array();
    for (const float weight : hour.weights)
        weights.push_back(digits(double(weight)));
    Json direction = Json::array();
    for (int axis = 0; axis < 3; ++axis)
        direction.push_back(digits(double(hour.sun[axis])));
    return {{"hour", hour.name},
            {"sun", direction},
            {"lux", digits(double(hour.lux))},
            {"mean", digits(hour.mean)},
            {"error", digits(hour.error)},
            {"weights", weights}};
}

}  // namespace

std::vector<std::string> write_daylight(const OutputFolder& folder, const BakeOptions& options,
                                        const SolveScene& prepared, const WantedDaylight& wanted,
                                        const DaylightMaps& maps,
                                        const std::vector<glm::vec3>& irradiance, Stages& stages)
{
    const Weather& weather = wanted.weather();
    const Pages& pages = prepared.atlas.pages;
    const std::vector<Image> images = finish_daylight(prepared, maps, irradiance);
    std::vector<std::string> files;
    Json rows = Json::array();
    for (std::size_t k = 0; k < images.size(); ++k) {
        const std::string hour = wanted.name(maps.hours[k]);
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
    Json hours = Json::array();
    for (const HourOfDaylight& hour : hours_with_light(wanted, maps))
        hours.push_back(json_of(hour));
    write_compact_json(folder.path(kDaylightFile),
                       {{"place",
                         {{"name", weather.city},
                          {"latitude", glm::degrees(weather.latitude)},
                          {"longitude", glm::degrees(weather.longitude)}}},
                        {"error", maps.error},
                        {"maps", rows},
                        {"hours", hours}});
    files.emplace_back(kDaylightFile);
    stages.tell(fmt::format("{} maps of daylight; their sums are that of all hours of the year "
                            "within {}, but for direct light of the sun",
                            images.size(), percent_text(maps.error)));
    stages.tell(weather_summary(weather, wanted.year(), kWholeDay));
    return files;
}

}  // namespace lumel
