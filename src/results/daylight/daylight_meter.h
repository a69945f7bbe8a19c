#pragma once
// Daylight at a point: of one hour, and figures over the occupied hours of a year.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "results/daylight/daylight_year.h"
#include "results/daylight/reflected_daylight.h"
#include "results/measure/light_meter.h"

namespace lumel {

/// Upper bounds of the three lower ranges of useful daylight illuminance [lx]. [MAR12]
inline constexpr std::array<double, 3> kUsefulDaylight = {100.0, 300.0, 3000.0};
/// Share of the occupied hours with the target illuminance, from which on a point counts. [LM83]
inline constexpr double kSufficientHours = 0.5;
/// Share of the rays of a point that reach the sky through no glass, above which it is outdoors.
inline constexpr double kOutdoors = 0.5;

/// Daylight coefficients [TW83] of a point by luminance: of the patches of a DaylightYear, then of
/// the positions of its sun, reflected light only.
struct DaylightCoefficients {
    std::vector<std::vector<float>> of_sets;  ///< [kRaySets] by independent rays
    std::vector<float> mean;
    double open = 0.0;    ///< share of the rays that reach the sky through no glass
    bool inside = false;  ///< as Reading::inside
};

/// Illuminance of an hour.
struct HourReading {
    double lux = 0.0;
    double noise = 0.0;  ///< standard error by the rays of the point alone [lx]
    /// Error by interpolation of the sun's position: an estimate, from a grid twice as wide [lx].
    double interpolation = 0.0;
};

struct DaylightReading {
    double factor = 0.0;             ///< daylight factor, 0…1 of that outdoors
    double factor_noise = 0.0;       ///< its standard error by the rays alone
    double autonomy = 0.0;           ///< share of the occupied hours with the target illuminance
    std::array<double, 4> useful{};  ///< shares of the hours in the ranges of kUsefulDaylight
    double mean_lux = 0.0;           ///< over the occupied hours [lx]
    std::optional<HourReading> hour = {};  ///< if it was asked for
    double open = 0.0;                     ///< as DaylightCoefficients::open
    bool inside = false;                   ///< as Reading::inside; the figures are then 0

    bool is_outdoors() const { return !inside && open > kOutdoors; }
};

/// Thread-safe.
class DaylightMeter {
public:
    /// All arguments must outlive this. meter: of the lumels of `reflected`.
    DaylightMeter(const LightMeter& meter, const DaylightYear& year,
                  const ReflectedDaylight& reflected, std::uint32_t seed);

    /// number: of the point; selects its random numbers. one: an hour of the year's that is read
    /// too.
    DaylightReading read(const MeterPoint& point, std::uint32_t number, double target,
                         std::optional<std::size_t> one = {}) const;

    DaylightCoefficients coefficients(const MeterPoint& point, std::uint32_t number) const;
    /// hour: of the year's.
    HourReading hour(const MeterPoint& point, std::uint32_t number,
                     const DaylightCoefficients& coefficients, std::size_t hour) const;

private:
    float direct_sun(const MeterPoint& point, std::uint32_t number, std::size_t hour) const;
    /// Hours [first, last) of the year.
    struct Hours {
        std::size_t first, last;
    };
    std::vector<float> sky_and_reflected(std::span<const float> coefficients,
                                         const Hours& hours) const;
    std::vector<float> lux_of(const MeterPoint& point, std::uint32_t number,
                              const DaylightCoefficients& coefficients, const Hours& hours) const;

    const LightMeter& meter_;
    const DaylightYear& year_;
    const ReflectedDaylight& reflected_;
    std::uint32_t seed_;
    std::size_t patches_;          ///< of the year
    std::vector<float> overcast_;  ///< [patches_] luminance of the overcast sky per lux [cd/m²/lx]
};

/// Figures of a plane, over the points that are neither inside objects nor outdoors.
struct DaylightFigures {
    std::size_t count = 0, outdoors = 0;
    double factor = 0.0;      ///< mean daylight factor
    double sufficient = 0.0;  ///< share of the points with kSufficientHours: sDA
    double useful = 0.0;      ///< mean share of hours in the two middle ranges
};

DaylightFigures figures_of(std::span<const DaylightReading> readings);

}  // namespace lumel
