#pragma once
// Sky and sun of the occupied hours of a year.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/sky/sky_patches.h"
#include "scene/sky/weather_file.h"

namespace lumel {

/// Hours of the day, local standard time.
struct OccupiedHours {
    int from = 8, to = 18;  ///< 0 ≤ from < to ≤ 24
};

class DaylightYear {
public:
    DaylightYear(const Weather& weather, const OccupiedHours& occupied);

    std::size_t hours() const { return suns_.size(); }
    /// Index of an hour in Weather::hours.
    std::size_t number(std::size_t hour) const { return numbers_[hour]; }

    /// Illuminance of open ground in an hour by sky and sun [lx].
    double open_ground(std::size_t hour) const;
    const SkyPatches& patches() const { return patches_; }
    /// Fraction of the solid angle of its whole patch that a patch has.
    float share(std::size_t patch) const { return shares_[patch]; }
    /// Luminance of a patch in all hours [hours()] [cd/m²].
    std::span<const float> luminance(std::size_t patch) const
    {
        return std::span(luminance_).subspan(patch * hours(), hours());
    }

    /// The sun of an hour, its light interpolated between positions on a grid.
    struct Sun {
        glm::vec3 direction{0.0f, 1.0f, 0.0f};  ///< unit, to it
        float lux = 0.0f;                       ///< on a plane that faces it; 0 below the horizon
        struct Share {
            std::uint32_t place;  ///< index into sun_places()
            float weight;         ///< the four add up to 1
        };
        std::array<Share, 4> near{};
        /// Of a grid twice as wide, for the error of interpolation.
        std::array<Share, 4> wide{};

        using Grid = std::array<Share, 4> Sun::*;
    };
    const Sun& sun(std::size_t hour) const { return suns_[hour]; }
    /// Strengths in an hour of the sources of CoefficientOf: mean luminance of each of the 145
    /// patches of [Tre87] [cd/m²], then illuminance by the sun at each of its places [lx].
    /// grid: of the sun, near or wide.
    std::vector<float> strengths(std::size_t hour, Sun::Grid grid) const;
    /// Unit directions to the positions between which the sun is interpolated.
    std::span<const glm::vec3> sun_places() const { return places_; }

private:
    void add_sky(const WeatherHour& hour, const Weather& weather, std::size_t index);
    void place_suns(double latitude);

    SkyPatches patches_;
    std::vector<float> shares_;  ///< [patches]
    std::vector<std::size_t> numbers_;
    std::vector<float> luminance_;  ///< [patches][hours]
    std::vector<Sun> suns_;         ///< [hours]
    std::vector<glm::vec3> places_;
};

}  // namespace lumel
