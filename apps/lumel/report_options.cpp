// The options of lumel report.

#include <memory>

#include "option_values.h"
#include "shared_options.h"

namespace lumel {
namespace {

constexpr const char* kRoomGroup = "Report of a room by EN 12464-1";
constexpr double kMostLux = 1e5;

void add_room(Command& command, RoomOptions& room)
{
    command.add(
        kRoomGroup,
        {{"--en12464", "USE",
          "Add maintained illuminance, uniformity and lamps, with what the standard requires: " +
              names_of_room_uses(),
          &room.use},
         rectangle(room.task,
                   {.names = "--task",
                    .help = "Corners of the task area in metres; around it, the immediate "
                            "surrounding area and the background are measured too",
                    .default_value = "the room without a strip of 0.5 m",
                    .needs = "--en12464"}),
         rectangle(room.bounds, {.names = "--bounds",
                                 .help = "Corners of the room in metres",
                                 .default_value = "the bounds of the floor",
                                 .needs = "--en12464"}),
         {.names = "--plane",
          .type = "Y",
          .help = "Height of the task area in metres",
          .target = [&room](double height) { room.height = height; },
          .default_value = "by the use, above the floor",
          .check = between(-kFarthest, kFarthest),
          .needs = "--en12464"},
         {.names = "--maintenance",
          .type = "F",
          .help = "Maintenance factor: illuminance before cleaning and new lamps, relative to that "
                  "of the bake",
          .target = &room.maintenance,
          .default_value = text_of(room.maintenance),
          .check = between(0.01, 1.0),
          .needs = "--en12464"},
         {.names = "--illuminance",
          .type = "LX",
          .help = "Required maintained illuminance of the task area in lux",
          .target = [&room](double lux) { room.illuminance = lux; },
          .default_value = "by the use",
          .check = between(0.0, kMostLux),
          .needs = "--en12464"},
         {.names = "--uniformity",
          .type = "U",
          .help = "Required uniformity of the task area",
          .target = [&room](double uniformity) { room.uniformity = uniformity; },
          .default_value = "by the use",
          .check = between(0.0, 1.0),
          .needs = "--en12464"},
         {.names = "--samples",
          .type = "N",
          .help = "Hemisphere rays per point; as many again go to light sources",
          .target = &room.samples,
          .default_value = text_of(room.samples),
          .check = whole(kMinSamples, kMaxSamples),
          .needs = "--en12464"}});
}

}  // namespace

Command report_command()
{
    const auto given = std::make_shared<ReportArguments>();
    Command command{.name = "report",
                    .help = "Write an HTML page to explore a bake or to compare two"};
    command.add(
        {bake_argument(given->folder),
         {"other", "FOLDER", "Second bake, compared with the first by a slider", &given->other}});
    add_room(command, given->room);
    command.add("Files", {{"-o,--output", "FILE", "HTML file to write", &given->page,
                           "report.html in the first folder"}});
    command.arguments = [given](const Command&) -> Arguments { return {*given}; };
    return command;
}

}  // namespace lumel
