// A point's illuminance in an hour is a sum over patches k of luminance L_k, and the sun:
//
//     E = Σ_k L_k C_k + E_s (τ cosθ_s + Σ_p w_p C_p)                          [TW83]
//
// C_k is π/R Σ τ over the rays that leave through k, plus the light of the lumels that rays hit,
// 1/R Σ τ B_k; C_p is the latter for the sun at position p, with weights w_p (daylight_year.cpp).
// Direct light of the sun takes one shadow ray an hour to a random point of its disc.
//
// [LM83] IES LM-83-12. Spatial Daylight Autonomy (sDA) and Annual Sunlight Exposure (ASE).

#include "results/daylight/daylight_meter.h"

#include <algorithm>
#include <cmath>

#include "base/core/frame.h"
#include "base/core/luminance.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"
#include "results/daylight/dot.h"
#include "results/measure/ray_sets.h"
#include "scene/sky/cie_sky.h"
#include "scene/sky/clear_sky.h"

namespace lumel {
namespace {

/// Standard error of the mean of `of` each set.
template <class Of>
double noise_of(const Of& of)
{
    std::array<double, kRaySets> values;
    double mean = 0.0, squares = 0.0;
    for (std::size_t set = 0; set < kRaySets; ++set)
        mean += (values[set] = of(set)) / double(kRaySets);
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return standard_error(squares);
}

/// For a sun of 1 lx, by the coefficients of its positions.
float reflected_sun(std::span<const DaylightYear::Sun::Share> shares,
                    std::span<const float> of_places)
{
    float sum = 0.0f;
    for (const DaylightYear::Sun::Share& share : shares)
        sum += share.weight * of_places[share.place];
    return sum;
}

}  // namespace

DaylightMeter::DaylightMeter(const LightMeter& meter, const DaylightYear& year,
                             const ReflectedDaylight& reflected, std::uint32_t seed)
    : meter_(meter),
      year_(year),
      reflected_(reflected),
      seed_(seed),
      patches_(year.patches().count())
{
    const std::vector<double> overcast = year.patches().means(
        [](const glm::dvec3& direction) { return cie_luminance(kOvercastType, direction.y, 0.0); });
    double on_plane = 0.0;
    for (std::size_t k = 0; k < patches_; ++k) {
        on_plane += overcast[k] * year.patches().projected(k);
    }
    for (const double luminance : overcast)
        overcast_.push_back(float(luminance / on_plane));
}

DaylightCoefficients DaylightMeter::coefficients(const MeterPoint& point,
                                                 std::uint32_t number) const
{
    const std::size_t places = year_.sun_places().size(), wholes = reflected_.count() - places;
    DaylightCoefficients found;
    found.of_sets.assign(kRaySets, std::vector<float>(patches_ + places, 0.0f));
    std::vector<std::vector<double>> by_lumels(kRaySets,
                                               std::vector<double>(reflected_.count(), 0.0));
    const float share = 1.0f / float(meter_.rays_in_set());
    found.inside = meter_.visit_rays(
        point, number, [&](std::uint32_t set, const glm::vec3& direction, const MetLight& met) {
            if (met.is_sky) {
                found.open += met.tint == glm::vec3(1.0f) ? double(share) / kRaySets : 0.0;
                const std::uint32_t patch = year_.patches().at(direction);
                if (patch != SkyPatches::kNone)
                    found.of_sets[set][patch] += share * kPi * float(luminance(met.tint));
            } else if (met.lumel != HitLumels::kNone) {
                const glm::vec3* const sent = reflected_.of(met.lumel);
                for (std::size_t k = 0; k < by_lumels[set].size(); ++k)
                    by_lumels[set][k] += luminance(share * met.tint * sent[k]);
            }
        });
    found.mean.assign(patches_ + places, 0.0f);
    for (std::size_t set = 0; set < kRaySets; ++set) {
        std::vector<float>& of_set = found.of_sets[set];
        for (std::size_t k = 0; k < patches_; ++k)
            of_set[k] += year_.share(k) * float(by_lumels[set][year_.patches().whole(k)]);
        for (std::size_t p = 0; p < places; ++p)
            of_set[patches_ + p] = float(by_lumels[set][wholes + p]);
        for (std::size_t k = 0; k < of_set.size(); ++k)
            found.mean[k] += of_set[k] / float(kRaySets);
    }
    return found;
}

/// Direct light [lx] of the sun.
float DaylightMeter::direct_sun(const MeterPoint& point, std::uint32_t number,
                                std::size_t hour) const
{
    const DaylightYear::Sun& sun = year_.sun(hour);
    if (!(sun.lux > 0.0f) || !(glm::dot(sun.direction, point.normal) > -kSunAngle))
        return 0.0f;
    const PathSamples samples(PathSamples::hash(seed_, number), std::uint32_t(hour));
    const glm::vec3 direction =
        frame_about(sun.direction) * in_cone(samples.random(kDirectionPair), kSunAngle);
    return sun.lux * float(luminance(meter_.light_from(point, direction, samples.bits(kSeedPair))));
}

/// Illuminance [lx] but for direct light of the sun.
std::vector<float> DaylightMeter::sky_and_reflected(std::span<const float> coefficients,
                                                    const Hours& hours) const
{
    std::vector<float> lux(hours.last - hours.first, 0.0f);
    for (std::size_t k = 0; k < patches_; ++k) {
        const float coefficient = coefficients[k];
        const std::span<const float> luminance = year_.luminance(k).subspan(hours.first);
        for (std::size_t h = 0; coefficient > 0.0f && h < lux.size(); ++h)
            lux[h] += coefficient * luminance[h];
    }
    for (std::size_t h = 0; h < lux.size(); ++h)
        if (const DaylightYear::Sun& sun = year_.sun(hours.first + h); sun.lux > 0.0f)
            lux[h] += sun.lux * reflected_sun(sun.near, coefficients.subspan(patches_));
    return lux;
}

/// Illuminance [lx].
std::vector<float> DaylightMeter::lux_of(const MeterPoint& point, std::uint32_t number,
                                         const DaylightCoefficients& coefficients,
                                         const Hours& hours) const
{
    std::vector<float> lux = sky_and_reflected(coefficients.mean, hours);
    for (std::size_t h = 0; h < lux.size(); ++h)
        lux[h] += direct_sun(point, number, hours.first + h);
    return lux;
}

HourReading DaylightMeter::hour(const MeterPoint& point, std::uint32_t number,
                                const DaylightCoefficients& coefficients, std::size_t hour) const
{
    const Hours one{hour, hour + 1};
    HourReading reading{.lux = double(lux_of(point, number, coefficients, one).front())};
    reading.noise = noise_of([&](std::size_t set) {
        return double(sky_and_reflected(coefficients.of_sets[set], one).front());
    });
    const DaylightYear::Sun& sun = year_.sun(hour);
    const std::span<const float> of_places = std::span(coefficients.mean).subspan(patches_);
    if (sun.lux > 0.0f)
        reading.interpolation = double(sun.lux * std::abs(reflected_sun(sun.near, of_places) -
                                                          reflected_sun(sun.wide, of_places)));
    return reading;
}

DaylightReading DaylightMeter::read(const MeterPoint& point, std::uint32_t number, double target,
                                    std::optional<std::size_t> one) const
{
    const DaylightCoefficients found = coefficients(point, number);
    DaylightReading reading{.open = found.open, .inside = found.inside};
    if (one)
        reading.hour = found.inside ? HourReading{} : hour(point, number, found, *one);
    if (found.inside)
        return reading;
    const auto factor = [&](std::span<const float> coefficients) {
        return dot(coefficients.first(patches_), overcast_);
    };
    reading.factor = factor(found.mean);
    reading.factor_noise = noise_of([&](std::size_t set) { return factor(found.of_sets[set]); });
    const std::vector<float> lux = lux_of(point, number, found, {0, year_.hours()});
    const double share = lux.empty() ? 0.0 : 1.0 / double(lux.size());
    for (const float value : lux) {
        const auto range =
            std::upper_bound(kUsefulDaylight.begin(), kUsefulDaylight.end(), double(value)) -
            kUsefulDaylight.begin();
        reading.useful[std::size_t(range)] += share;
        reading.autonomy += double(value) >= target ? share : 0.0;
        reading.mean_lux += share * double(value);
    }
    return reading;
}

DaylightFigures figures_of(std::span<const DaylightReading> readings)
{
    DaylightFigures figures;
    for (const DaylightReading& reading : readings) {
        figures.outdoors += reading.is_outdoors() ? 1 : 0;
        if (reading.inside || reading.is_outdoors())
            continue;
        ++figures.count;
        figures.factor += reading.factor;
        figures.sufficient += reading.autonomy >= kSufficientHours ? 1.0 : 0.0;
        figures.useful += reading.useful[1] + reading.useful[2];
    }
    if (figures.count > 0)
        for (double* figure : {&figures.factor, &figures.sufficient, &figures.useful})
            *figure /= double(figures.count);
    return figures;
}

}  // namespace lumel
