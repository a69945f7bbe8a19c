// The options of lumel measure.

#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "base/core/error.h"
#include "command.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr const char* kPlacesGroup = "Where to measure";
constexpr const char* kFilesGroup = "Files";
constexpr int kMinSamples = 64, kMaxSamples = 1 << 24;

[[noreturn]] void refuse(const std::string& what)
{
    throw Error(ErrorKind::input, "", what);
}

MeasurePoint point_of(const std::string& text)
{
    const std::vector<double> n = coordinates_of(text);
    if (n.size() != 3 && n.size() != 6)
        refuse(fmt::format("--at: '{}' is not of the form X,Y,Z or X,Y,Z,NX,NY,NZ", text));
    MeasurePoint point{.place = {n[0], n[1], n[2]}};
    if (n.size() == 6)
        point.normal = {n[3], n[4], n[5]};
    if (!(glm::length(point.normal) > 0.0))
        refuse(fmt::format("--at: the normal of '{}' has no length", text));
    return point;
}

std::array<double, 4> bounds_of(const std::string& text)
{
    const std::vector<double> n = coordinates_of(text);
    if (n.size() != 4 || !(n[0] < n[2]) || !(n[1] < n[3]))
        refuse(fmt::format("--bounds: '{}' is not of the form X0,Z0,X1,Z1 with X0 < X1 and Z0 < Z1",
                           text));
    return {n[0], n[1], n[2], n[3]};
}

void add_places(CLI::App& app, MeasureOptions& options)
{
    app.option_defaults()->group(kPlacesGroup);
    auto* at = app.add_option_function<std::vector<std::string>>(
                      "--at",
                      [&options](const std::vector<std::string>& texts) {
                          for (const std::string& text : texts)
                              options.points.push_back(point_of(text));
                      },
                      "Point in metres, in the air or on a surface, and what it faces, up if that "
                      "is left out; may be repeated")
                   ->type_name("X,Y,Z[,NX,NY,NZ]")
                   ->allow_extra_args(false);  // one at a time, so that a folder may follow
    auto* plane = app.add_option_function<double>(
                         "--plane", [&options](double height) { options.height = height; },
                         "Height in metres of a work plane, horizontal, facing up, that blocks "
                         "nothing; points inside of things are left out")
                      ->type_name("Y")
                      ->check(between(-kFarthest, kFarthest))
                      ->excludes(at);
    app.add_option("--spacing", options.spacing, "Metres from point to point of the plane")
        ->type_name("F")
        ->default_str("1/20 of its longer side")
        ->check(positive())
        ->needs(plane);
    app.add_option_function<std::string>(
           "--bounds", [&options](const std::string& text) { options.bounds = bounds_of(text); },
           "Corners of the plane in metres")
        ->type_name("X0,Z0,X1,Z1")
        ->default_str("the scene's")
        ->needs(plane);
    app.add_option("--samples", options.samples,
                   "Rays of a point over its hemisphere, and as many towards lights")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(kMinSamples, kMaxSamples));
}

void add_files(CLI::App& app, MeasureOptions& options)
{
    app.option_defaults()->group(kFilesGroup);
    app.add_option("--csv", options.table, "Write all points as a table")->type_name("FILE.csv");
    app.add_option("--false-colour", options.picture,
                   "Write a picture of the plane in false colours, with a legend in lux")
        ->type_name("FILE.png")
        ->needs(app.get_option("--plane"));
    app.add_option("--preview", options.preview,
                   "Write the view of preview.png in false colours, with a legend in lux")
        ->type_name("FILE.png");
    app.add_option("--width", options.width, "Width of that picture in pixels")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(1, kLargestAtlas))
        ->needs(app.get_option("--preview"));
}

}  // namespace

Command measure_command(CLI::App& program)
{
    const auto given = std::make_shared<MeasureArguments>();
    MeasureArguments& measure = *given;
    CLI::App& command = *program.add_subcommand(
        "measure", "Measure the light of a bake in lux: at points, or on a work plane");
    command.add_option("folder", measure.folder, "What lumel bake wrote")
        ->required()
        ->type_name("FOLDER");
    add_places(command, measure.options);
    add_files(command, measure.options);
    command.callback([&measure] {
        const MeasureOptions& options = measure.options;
        if (options.points.empty() && !options.height && options.preview.empty())
            refuse("lumel measure needs --at X,Y,Z, --plane Y or --preview FILE.png");
    });
    add_device_option(command, measure.options.device);
    add_talk_options(command, measure.talk);
    return {&command, [given]() -> Arguments { return *given; }};
}

}  // namespace lumel
