#pragma once
// Files of daylight over a year: bake --daylight.

#include <string>
#include <vector>

#include "jobs/bake/daylight.h"
#include "results/files/folder.h"

namespace lumel {

/// Writes the maps and daylight.json; irradiance as for finish_daylight(). Returns the files'
/// names.
std::vector<std::string> write_daylight(const OutputFolder& folder, const BakeOptions& options,
                                        const SolveScene& prepared, const WantedDaylight& wanted,
                                        const DaylightMaps& maps,
                                        const std::vector<glm::vec3>& irradiance, Stages& stages);

}  // namespace lumel
