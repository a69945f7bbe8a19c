#pragma once
// Daylight over a year: maps of a few hours, and weights that add them up to all others.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/prepare/solve_scene.h"
#include "base/core/image.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "results/daylight/daylight_maps.h"
#include "scene/sky/weather_file.h"

namespace lumel {

/// All hours of the days of a year.
inline constexpr OccupiedHours kWholeDay{0, 24};

/// Daylight that a bake is to have, before its long work.
class WantedDaylight {
public:
    /// Throws Error{input} with what is wrong with the weather file.
    explicit WantedDaylight(const std::string& weather_file);

    const Weather& weather() const { return weather_; }
    const DaylightYear& year() const { return year_; }
    /// "06-21T12": the hour of the year from 12 to 13 o'clock on 21 June.
    std::string name(std::size_t hour) const;
    /// Throws Error{input} if the maps do not fit. limit: of memory [bytes], 0: unknown.
    void check_memory(const SolveScene& prepared, const BakeOptions& options,
                      std::uint64_t limit) const;

private:
    Weather weather_;
    DaylightYear year_;
};

/// Reads the weather file of the options, and sets what the atlas must know of it; empty if they
/// have none. Throws Error{input} with what is wrong with the file.
std::optional<WantedDaylight> wanted_daylight(BakeOptions& options, Stages& stages);

/// The maps, in a stage of its own; options: of the atlas. If the caller stops, if there is no
/// light, or if the maps cannot be made, they are empty and the user is told.
std::optional<DaylightMaps> make_daylight_maps(const WantedDaylight& wanted,
                                               const SolveScene& prepared,
                                               const AtlasOptions& options, std::uint32_t seed,
                                               Stages& stages);

/// Finished maps [K] [lx], none negative. irradiance [N]: of the lightmap; decides, if there is
/// any, which side texels show that both sides share.
std::vector<Image> finish_daylight(const SolveScene& prepared, const DaylightMaps& maps,
                                   const std::vector<glm::vec3>& irradiance);

/// An hour with light.
struct HourOfDaylight {
    std::string name;                ///< as by WantedDaylight::name()
    glm::vec3 sun;                   ///< unit direction to it in the middle of the hour
    float lux;                       ///< by direct sun on a plane that faces it
    double mean;                     ///< illuminance of all surfaces without direct sun [lx]
    double error;                    ///< estimated, relative to the light of the hour
    std::span<const float> weights;  ///< [K] signed; the maps must outlive it
};

/// In the order of the calendar: a year of weather may begin in any month.
std::vector<HourOfDaylight> hours_with_light(const WantedDaylight& wanted,
                                             const DaylightMaps& maps);

}  // namespace lumel
