// The options of lumel probes.

#include <memory>
#include <vector>

#include <fmt/core.h>

#include "base/core/error.h"
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

void add_places(Command& command, ProbesOptions& options)
{
    command.add(
        kPlacesGroup,
        {{"--spacing", "F", "Grid of probes, this many metres apart, over the scene",
          &options.spacing, "", positive()},
         {.names = "--bounds",
          .type = "X0,Y0,Z0,X1,Y1,Z1",
          .help = "Corners of the grid in metres",
          .default_value = "the scene's",
          .target = [&options](const std::string& text) { options.bounds = bounds_of(text); },
          .needs = "--spacing"},
         {.names = "--at",
          .type = "X,Y,Z",
          .help = "Probe at a point in metres, beside those of nodes with extras.lumel.probe; may "
                  "be repeated",
          .target =
              [&options](const std::string& text) { options.places.push_back(place_of(text)); },
          .repeatable = true},
         {"--samples", "N",
          "Rays of a probe over the sphere, and as many towards lights, at least; up to 64 "
          "times as many where their noise is above 0.5 %",
          &options.samples, text_of(options.samples), whole(kMinSamples, kMaxSamples)}});
}

}  // namespace

Command probes_command()
{
    const auto given = std::make_shared<ProbesArguments>();
    Command command{
        .name = "probes",
        .help = "Find the light in the air of a bake: spherical harmonics at a grid or points"};
    command.add({bake_argument(given->folder)});
    add_places(command, given->options);
    command.add(kFilesGroup, {{"-o,--output", "FILE.json", "File to write", &given->options.file,
                               "probes.json in the folder"}});
    add_talk_options(command, given->talk);
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

}  // namespace lumel
