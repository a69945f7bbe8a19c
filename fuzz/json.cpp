// Readers of JSON beside glTF.

#include "base/json/json_file.h"
#include "jobs/relight/states_file.h"
#include "memory_file.h"
#include "results/page/daylight_list.h"
#include "results/page/lamp_list.h"
#include "results/record/bake_record.h"
#include "results/record/solver_settings.h"

namespace lumel::fuzz {

void read_report(Input input)
{
    const std::string path = "report.json";
    const Json report = parse_json(path, input.data(), input.size());
    const BakeRecord record = record_of(JsonView(path, report), "");
    const Json written = solver_settings(record.solver);
    const JsonView settings(path, written);
    require(solver_settings(solver_options_of(settings)) == written,
            "what was read can be written, and is read the same");
}

void read_states(Input input)
{
    const MemoryFile file(input);
    require(!lumel::read_states(file.path()).empty(), "there is a state");
}

void read_lamps(Input input)
{
    const std::string path = "lamps.json";
    const Json json = parse_json(path, input.data(), input.size());
    const std::vector<ListedLamp> lamps = lamps_of(JsonView(path, json), 1);
    require(!lamps.empty() && lamps.size() <= kMaxListedLamps, "there are 1 to 64 lamps");
}

void read_daylight(Input input)
{
    const std::string path = "daylight.json";
    const Json json = parse_json(path, input.data(), input.size());
    const ListedDaylight daylight = daylight_of(JsonView(path, json), 1);
    require(!daylight.maps.empty() && daylight.maps.size() <= kMaxDaylightMaps,
            "there are 1 to 48 maps");
    int before = -1;
    for (const ListedHour& hour : daylight.hours) {
        require(hour.index > before && hour.weights.size() == daylight.maps.size(),
                "hours are in order, and have a weight for each map");
        before = hour.index;
    }
}

}  // namespace lumel::fuzz
