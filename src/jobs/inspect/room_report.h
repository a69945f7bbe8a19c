#pragma once
// lumel report --en12464: illuminance on the work plane of a room, by lamps, against a standard.

#include <array>
#include <optional>
#include <string>

#include "base/json/json_view.h"
#include "results/measure/light_meter.h"
#include "results/measure/work_places.h"

namespace lumel {

struct RoomOptions {
    std::string use;                              ///< name of a RoomUse
    std::optional<double> height;                 ///< y [m]; default: the use's above the floor
    std::optional<std::array<double, 4>> bounds;  ///< min x, z, max x, z [m]; default: of the floor
    std::optional<std::array<double, 4>> task;    ///< task area [m]; default: nearly all
    double maintenance = 0.8;                     ///< maintained / new illuminance
    std::optional<double> illuminance;            ///< required of the task [lx]; default: the use's
    std::optional<double> uniformity;             ///< default: the use's
    std::uint32_t samples = LightMeterOptions{}.samples;
};

/// Measures in the folder of a bake; data for viewer/room.js. With lamps.json in the folder,
/// illuminance of each lamp apart; otherwise of all light. Throws Error{input} for an unknown use,
/// a task area without points in the open air, and a lamps.json without all lamps of the scene.
Json room_data(const std::string& folder, const RoomOptions& options);

/// Results of room_data() with all lamps as baked, one line per area.
std::string room_text(const Json& room);

}  // namespace lumel
