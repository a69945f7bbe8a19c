// The options of lumel probes.

#include <memory>
#include <vector>

#include <fmt/core.h>

#include "base/core/error.h"
#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr const char* kProbePlacesGroup = "Where to put light probes";
constexpr int kMinProbeSamples = 64, kMaxProbeSamples = 1 << 20;

glm::dvec3 place_of(const std::string& text)
{
    const std::vector<double> n = coordinates_of(text);
    if (n.size() != 3)
        refuse_value(fmt::format("--at: '{}' is not of the form X,Y,Z", text));
    return {n[0], n[1], n[2]};
}

std::array<double, 6> bounds_of(const std::string& text)
{
    const std::vector<double> n = coordinates_of(text);
    if (n.size() != 6 || !(n[0] < n[3]) || !(n[1] < n[4]) || !(n[2] < n[5]))
        refuse_value(
            fmt::format("--bounds: '{}' is not of the form X0,Y0,Z0,X1,Y1,Z1 with X0 < X1, Y0 < "
                        "Y1 and Z0 < Z1",
                        text));
    return {n[0], n[1], n[2], n[3], n[4], n[5]};
}

void add_places(Command& command, ProbesOptions& options)
{
    command.add(
        kProbePlacesGroup,
        {{"--spacing", "F", "Grid of probes over the scene, this many metres apart",
          &options.spacing, "", positive()},
         {.names = "--bounds",
          .type = "X0,Y0,Z0,X1,Y1,Z1",
          .help = "Corners of the grid in metres",
          .target = [&options](const std::string& text) { options.bounds = bounds_of(text); },
          .default_value = "the scene's",
          .needs = "--spacing"},
         {.names = "--at",
          .type = "X,Y,Z",
          .help = "Probe at a point in metres, in addition to nodes with extras.lumel.probe; "
                  "repeatable",
          .target =
              [&options](const std::string& text) { options.places.push_back(place_of(text)); },
          .repeatable = true},
         {"--samples", "N",
          "Minimum rays per probe over the sphere, and as many towards lights; up to 64 times as "
          "many if their noise is above 0.5 %",
          &options.samples, text_of(options.samples), whole(kMinProbeSamples, kMaxProbeSamples)}});
}

}  // namespace

Command probes_command()
{
    const auto given = std::make_shared<ProbesArguments>();
    Command command{
        .name = "probes",
        .help =
            "Compute light probes of a baked scene: spherical harmonics on a grid or at points"};
    command.add({bake_argument(given->folder)});
    add_places(command, given->options);
    command.add(kFilesGroup, {{"-o,--output", "FILE.json", "File to write", &given->options.file,
                               "probes.json in the folder"}});
    add_talk_options(command, given->talk);
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

}  // namespace lumel
