// The options of lumel probes.

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

constexpr const char* kPlacesGroup = "Where to put light probes";
constexpr const char* kFilesGroup = "Files";
constexpr int kMinSamples = 64, kMaxSamples = 1 << 20;

[[noreturn]] void refuse(const std::string& what)
{
    throw Error(ErrorKind::input, "", what);
}

glm::dvec3 place_of(const std::string& text)
{
    const std::vector<double> n = coordinates_of(text);
    if (n.size() != 3)
        refuse(fmt::format("--at: '{}' is not of the form X,Y,Z", text));
    return {n[0], n[1], n[2]};
}

std::array<double, 6> bounds_of(const std::string& text)
{
    const std::vector<double> n = coordinates_of(text);
    if (n.size() != 6 || !(n[0] < n[3]) || !(n[1] < n[4]) || !(n[2] < n[5]))
        refuse(fmt::format("--bounds: '{}' is not of the form X0,Y0,Z0,X1,Y1,Z1 with X0 < X1, Y0 < "
                           "Y1 and Z0 < Z1",
                           text));
    return {n[0], n[1], n[2], n[3], n[4], n[5]};
}

void add_places(CLI::App& app, ProbesOptions& options)
{
    app.option_defaults()->group(kPlacesGroup);
    auto* spacing = app.add_option("--spacing", options.spacing,
                                   "Grid of probes, this many metres apart, over the scene")
                        ->type_name("F")
                        ->check(positive());
    app.add_option_function<std::string>(
           "--bounds", [&options](const std::string& text) { options.bounds = bounds_of(text); },
           "Corners of the grid in metres")
        ->type_name("X0,Y0,Z0,X1,Y1,Z1")
        ->default_str("the scene's")
        ->needs(spacing);
    app.add_option_function<std::vector<std::string>>(
           "--at",
           [&options](const std::vector<std::string>& texts) {
               for (const std::string& text : texts)
                   options.places.push_back(place_of(text));
           },
           "Probe at a point in metres, beside those of nodes with extras.lumel.probe; may be "
           "repeated")
        ->type_name("X,Y,Z")
        ->allow_extra_args(false);  // one at a time, so that a folder may follow
    app.add_option(
           "--samples", options.samples,
           "Rays of a probe over the sphere, and as many towards lights, at least; up to 64 "
           "times as many where their noise is above 0.5 %")
        ->type_name("N")
        ->capture_default_str()
        ->check(whole(kMinSamples, kMaxSamples));
}

}  // namespace

Command probes_command(CLI::App& program)
{
    const auto given = std::make_shared<ProbesArguments>();
    ProbesArguments& probes = *given;
    CLI::App& command = *program.add_subcommand(
        "probes", "Find the light in the air of a bake: spherical harmonics at a grid or points");
    command.add_option("folder", probes.folder, "What lumel bake wrote")
        ->required()
        ->type_name("FOLDER");
    add_places(command, probes.options);
    command.option_defaults()->group(kFilesGroup);
    command.add_option("-o,--output", probes.options.file, "File to write")
        ->type_name("FILE.json")
        ->default_str("probes.json in the folder");
    add_talk_options(command, probes.talk);
    return {&command, [given]() -> Arguments { return *given; }};
}

}  // namespace lumel
