// The options of lumel measure.

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "base/core/error.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr const char* kMeasurePlacesGroup = "Where to measure";

MeasurePoint point_of(const std::string& text)
{
    const std::vector<double> n = coordinates_of(text);
    if (n.size() != 3 && n.size() != 6)
        refuse_value(fmt::format("--at: '{}' is not of the form X,Y,Z or X,Y,Z,NX,NY,NZ", text));
    MeasurePoint point{.place = {n[0], n[1], n[2]}};
    if (n.size() == 6)
        point.normal = {n[3], n[4], n[5]};
    if (!(glm::length(point.normal) > 0.0))
        refuse_value(fmt::format("--at: the normal of '{}' has no length", text));
    return point;
}

void add_places(Command& command, MeasureOptions& options)
{
    command.add(
        kMeasurePlacesGroup,
        {{.names = "--at",
          .type = "X,Y,Z[,NX,NY,NZ]",
          .help = "Point in metres, in the air or on a surface, and the normal of the receiver, by "
                  "default up; repeatable",
          .target =
              [&options](const std::string& text) { options.points.push_back(point_of(text)); },
          .repeatable = true},
         {.names = "--plane",
          .type = "Y",
          .help = "Height in metres of a horizontal work plane that faces up and casts no shadow; "
                  "points inside objects are left out",
          .target = [&options](double height) { options.height = height; },
          .check = between(-kFarthest, kFarthest),
          .excludes = "--at"},
         {.names = "--spacing",
          .type = "F",
          .help = "Distance between points of the plane in metres",
          .target = &options.spacing,
          .default_value = "1/20 of its longer side",
          .check = positive(),
          .needs = "--plane"},
         rectangle(options.bounds, {.names = "--bounds",
                                    .help = "Corners of the plane in metres",
                                    .default_value = "the scene's",
                                    .needs = "--plane"}),
         {"--samples", "N", "Hemisphere rays per point; as many again go to light sources",
          &options.samples, text_of(options.samples), whole(kMinSamples, kMaxSamples)}});
}

/// A number of one or two digits.
std::optional<int> digits_of(std::string_view text)
{
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    if (text.empty() || text.size() > 2 || !std::ranges::all_of(text, is_digit))
        return std::nullopt;
    int number = 0;
    for (const char digit : text)
        number = 10 * number + (digit - '0');
    return number;
}

/// "8-18"
OccupiedHours hours_of(const std::string& text)
{
    constexpr int kHoursOfDay = 24;
    const std::size_t dash = std::min(text.find('-'), text.size());
    const std::string_view whole = text;
    const auto from = digits_of(whole.substr(0, dash));
    const auto to = digits_of(whole.substr(std::min(dash + 1, text.size())));
    if (!from || !to || *to > kHoursOfDay || *from >= *to)
        refuse_value(fmt::format(
            "--hours: '{}' is not of the form FROM-TO with whole hours from 0 to 24", text));
    return {*from, *to};
}

/// "06-21T15"
HourOfYear hour_of(const std::string& text)
{
    constexpr int kMonths = 12, kDays = 31, kHoursOfDay = 24;
    const std::string_view whole = text;
    const bool has_form =
        text.size() == std::string_view("MM-DDTHH").size() && text[2] == '-' && text[5] == 'T';
    const auto part = [&](std::size_t at) {
        return has_form ? digits_of(whole.substr(at, 2)) : std::nullopt;
    };
    const auto month = part(0), day = part(3), begins = part(6);
    if (!month || !day || !begins || *month < 1 || *month > kMonths || *day < 1 || *day > kDays ||
        *begins >= kHoursOfDay)
        refuse_value(fmt::format("--hour: '{}' is not of the form MM-DDTHH, as in 06-21T15 for the "
                                 "hour from 15 to 16 o'clock on 21 June",
                                 text));
    return {*month, *day, *begins};
}

void add_daylight(Command& command, DaylightOptions& options)
{
    command.add(
        "Daylight over a year",
        {{"--weather", "FILE.epw",
          "Weather file, for the daylight factor, daylight autonomy and useful daylight over a "
          "year: of sky and sun alone, whatever lights the bake has",
          &options.weather},
         {.names = "--hours",
          .type = "FROM-TO",
          .help = "Occupied hours of the day that count, local standard time",
          .target = [&options](const std::string& text) { options.occupied = hours_of(text); },
          .default_value = fmt::format("{}-{}", options.occupied.from, options.occupied.to),
          .needs = "--weather"},
         {.names = "--hour",
          .type = "MM-DDTHH",
          .help =
              "Lists the illuminance of one of these hours too, as in 06-21T15 for that from 15 "
              "to 16 o'clock on 21 June, with the noise of the point's rays",
          .target = [&options](const std::string& text) { options.hour = hour_of(text); },
          .needs = "--weather"},
         {.names = "--target",
          .type = "LUX",
          .help = "Illuminance for daylight autonomy",
          .target = &options.target,
          .default_value = text_of(options.target),
          .check = positive(),
          .needs = "--weather"}});
}

void add_files(Command& command, MeasureOptions& options)
{
    command.add(
        kFilesGroup,
        {{"--csv", "FILE.csv", "Write all points as a table", &options.table},
         {.names = "--false-colour",
          .type = "FILE.png",
          .help = "Write an image of the plane in false colours, with a legend in lux",
          .target = &options.picture,
          .needs = "--plane"},
         {"--preview", "FILE.png",
          "Write the view of preview.png in false colours, with a legend in lux", &options.preview},
         {.names = "--width",
          .type = "N",
          .help = "Width of the image of --preview in pixels",
          .target = &options.width,
          .default_value = text_of(options.width),
          .check = whole(1, kLargestAtlas),
          .needs = "--preview"}});
}

}  // namespace

Command measure_command()
{
    const auto given = std::make_shared<MeasureArguments>();
    MeasureOptions& options = given->options;
    Command command{.name = "measure",
                    .help = "Measure illuminance in a baked scene, at points or on a work plane"};
    command.add({bake_argument(given->folder)});
    add_places(command, options);
    add_daylight(command, options.daylight);
    add_files(command, options);
    add_device_option(command, options.device);
    add_talk_options(command, given->talk);
    command.arguments = [given](const Command&) -> Arguments {
        const MeasureOptions& wanted = given->options;
        if (wanted.points.empty() && !wanted.height && wanted.preview.empty())
            refuse_value("lumel measure needs --at X,Y,Z, --plane Y or --preview FILE.png");
        if (!wanted.daylight.weather.empty() && wanted.points.empty() && !wanted.height)
            refuse_value("--weather needs --at X,Y,Z or --plane Y");
        return {*given};
    };
    return command;
}

}  // namespace lumel
