#pragma once
// Maps of daylight over a year: bake --daylight.

#include <optional>
#include <string>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "results/daylight/daylight_maps.h"
#include "results/files/folder.h"
#include "scene/sky/weather_file.h"

namespace lumel {

/// Daylight that --daylight asks for, before the long work of a bake.
class WantedDaylight {
public:
    /// Throws Error{input} with what is wrong with the weather file.
    explicit WantedDaylight(const std::string& weather_file);

    const Weather& weather() const { return weather_; }
    const DaylightYear& year() const { return year_; }
    /// Throws Error{input} if the maps do not fit. limit: of memory [bytes], 0: unknown.
    void check_memory(const SolveScene& prepared, const BakeOptions& options,
                      std::uint64_t limit) const;

private:
    Weather weather_;
    DaylightYear year_;
};

/// The maps, in a stage of its own; options: of the atlas; empty if the caller stopped, and if
/// there is no light.
std::optional<DaylightMaps> make_daylight_maps(const WantedDaylight& wanted,
                                               const SolveScene& prepared,
                                               const AtlasOptions& options, std::uint32_t seed,
                                               Stages& stages);

/// Writes the maps and daylight.json. irradiance [N]: of the lightmap; decides, if there is any,
/// which side texels show that both sides share. Returns the files' names.
std::vector<std::string> write_daylight(const OutputFolder& folder, const BakeOptions& options,
                                        const SolveScene& prepared, const WantedDaylight& wanted,
                                        const DaylightMaps& maps,
                                        const std::vector<glm::vec3>& irradiance, Stages& stages);

}  // namespace lumel
