// Direct light of sky and sun by rays (sky_rays.h), reflected light by links, kLampLanes hours at
// once. The filter has the gains of a typical hour: their sum, each relative to its light on open
// ground.

#include "results/daylight/light_of_hours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/core/luminance.h"
#include "base/core/parallel.h"
#include "links/filter/mean.h"
#include "links/trace/links.h"
#include "results/daylight/error_weights.h"
#include "results/daylight/sky_rays.h"
#include "scene/sky/sky_patches.h"

namespace lumel {
namespace {

constexpr std::size_t kMappedPerStep = 2048, kMappedPerTask = 64;
/// Rays of a lumel to the sky and of its links.
constexpr std::uint32_t kToSky = 512, kOfLinks = 384;
/// Shadow rays to each sun: least of a lumel, and least of all lumels, so that small sunlit patches
/// get enough whatever the size of lumels.
constexpr std::uint32_t kLeastToSun = 4, kToSun = 400'000;
/// Shares of the work, for the progress bar only.
constexpr double kSkyPart = 0.4, kLinkedPart = 0.6;

/// Direct light [lx].
struct DirectOfHours {
    std::vector<Estimates> sky, sun;  ///< [hours][N]
    std::array<Estimates, 2> halves;  ///< [N] of the sky in a typical hour, by half of the rays
    std::vector<float> of_sky;        ///< [N] of a sky of 1 cd/m²
};

/// Traces direct light of hours.
class RaysOfHours {
public:
    RaysOfHours(const SolveScene& scene, const DaylightYear& year,
                std::span<const std::size_t> hours, std::uint32_t seed)
        : year_(year),
          hours_(hours),
          rays_(scene),
          to_sun_(std::max(kLeastToSun, kToSun / std::uint32_t(scene.lumels.lumels.size() + 1))),
          seed_(seed)
    {
        for (const std::size_t hour : hours)
            shares_.push_back(float(1.0 / year.open_ground(hour)));
        for (std::size_t k = 0; k < year.patches().count(); ++k) {
            float typical = 0.0f;
            for (std::size_t m = 0; m < hours.size(); ++m) {
                luminance_.push_back(year.luminance(k)[hours[m]]);
                typical += shares_[m] * luminance_.back();
            }
            typical_.push_back(typical);
        }
    }

    /// Weight of an hour in the typical hour.
    float share(std::size_t hour) const { return shares_[hour]; }

    void find(std::size_t lumel, DirectOfHours& light) const
    {
        for (std::uint32_t half = 0; half < light.halves.size(); ++half)
            rays_.visit(lumel, kToSky / 2, PathSamples::hash(seed_, half),
                        [&](const glm::vec3& direction, const glm::vec3& found) {
                            light.of_sky[lumel] += float(0.5 * luminance(found));
                            add(lumel, half, year_.patches().at(direction), found, light);
                        });
        for (std::size_t m = 0; m < hours_.size(); ++m)
            if (const DaylightYear::Sun& sun = year_.sun(hours_[m]); sun.lux > 0.0f)
                light.sun[m][lumel] = sun.lux * rays_.sun(lumel, sun.direction,
                                                          std::uint32_t(hours_[m]), to_sun_, seed_);
    }

private:
    void add(std::size_t lumel, std::size_t half, std::uint32_t patch, const glm::vec3& found,
             DirectOfHours& light) const
    {
        if (patch == SkyPatches::kNone)
            return;
        light.halves[half][lumel] += typical_[patch] * found;
        for (std::size_t m = 0; m < hours_.size(); ++m)
            light.sky[m][lumel] += 0.5f * luminance_[patch * hours_.size() + m] * found;
    }

    const DaylightYear& year_;
    std::span<const std::size_t> hours_;
    SkyRays rays_;
    std::uint32_t to_sun_;
    std::uint32_t seed_;
    std::vector<float> shares_;     ///< [hours]
    std::vector<float> luminance_;  ///< [patches][hours]
    std::vector<float> typical_;    ///< [patches]
};

DirectOfHours trace(const SolveScene& scene, const RaysOfHours& rays, std::size_t hours,
                    const ProgressCallback& progress)
{
    const std::size_t lumels = scene.lumels.lumels.size();
    const Estimates none(lumels, glm::vec3(0.0f));
    DirectOfHours light{std::vector<Estimates>(hours, none),
                        std::vector<Estimates>(hours, none),
                        {none, none},
                        std::vector<float>(lumels, 0.0f)};
    parallel_steps(
        lumels, kMappedPerStep, kMappedPerTask,
        [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i)
                if (!(scene.lumels.lumels[i].flags & kLumelBuried))
                    rays.find(i, light);
        },
        [&](std::size_t count) {
            notify(progress, double(count) / double(lumels));
            return true;
        });
    return light;
}

/// Replaces light of the sun by reflected light of sky and sun.
void reflect(const LinkRadiosity& links, std::size_t first, DirectOfHours& light)
{
    const std::size_t lumels = light.sky.front().size();
    const std::size_t width = std::min(kLampLanes, light.sky.size() - first);
    std::vector<glm::vec3> lanes(lumels * kLampLanes, glm::vec3(0.0f));
    for (std::size_t lane = 0; lane < width; ++lane)
        for (std::size_t i = 0; i < lumels; ++i)
            lanes[i * kLampLanes + lane] = light.sky[first + lane][i] + light.sun[first + lane][i];
    const std::vector<glm::vec3> reflected = links.reflected(lanes);
    for (std::size_t lane = 0; lane < width; ++lane)
        for (std::size_t i = 0; i < lumels; ++i)
            light.sun[first + lane][i] = reflected[i * kLampLanes + lane];
}

/// Weights of lumels and noise, by reflected and direct light of the typical hour.
void weigh(const SolveScene& scene, std::span<const float> of_sky,
           const std::array<Mean, 2>& typical, LightOfHours& found)
{
    const std::size_t lumels = of_sky.size();
    std::vector<float> light;
    for (std::size_t i = 0; i < lumels; ++i)
        light.push_back(float(luminance(typical[0].light[i] + typical[1].light[i])));
    found.weights = error_weights(scene, light, sees_sky(of_sky));
    std::array<SquaredError, 2> errors;
    double squares = 0.0;
    for (std::size_t i = 0; i < lumels; ++i) {
        const glm::vec3 whole = typical[0].light[i] + typical[1].light[i];
        for (std::size_t part = 0; part < typical.size(); ++part)
            errors[part].add(typical[part], i, double(found.weights[i]));
        squares += double(found.weights[i]) * double(glm::dot(whole, whole));
    }
    if (squares > 0.0)
        found.noise = std::sqrt((errors[0].sum() + errors[1].sum()) / squares);
}

}  // namespace

std::uint64_t light_of_hours_bytes(std::size_t lumels, std::size_t hours)
{
    constexpr std::size_t kSkyAndSun = 2;
    return kSkyAndSun * hours * lumels * sizeof(glm::vec3) +
           LinkRadiosity::first_bytes(lumels, kOfLinks, 0) +
           LinkRadiosity::lamp_bytes(lumels, kLampLanes);
}

LightOfHours light_of_hours(const SolveScene& scene, const DaylightYear& year,
                            std::span<const std::size_t> hours, std::uint32_t seed,
                            const ProgressCallback& progress)
{
    const std::size_t lumels = scene.lumels.lumels.size();
    const RaysOfHours rays(scene, year, hours, seed);
    DirectOfHours light = trace(scene, rays, hours.size(), part_of(progress, 0.0, kSkyPart));
    LinkRadiosity links(
        scene, LinksOptions{.seed = seed, .even_rays = kOfLinks, .outside_light = true}, {});
    while (!links.state().ended) {
        notify(progress, kSkyPart);
        links.step();
    }
    Estimates sent(lumels, glm::vec3(0.0f));
    for (std::size_t m = 0; m < hours.size(); ++m)
        for (std::size_t i = 0; i < lumels; ++i)
            sent[i] += rays.share(m) * (light.sky[m][i] + light.sun[m][i]);
    for (std::size_t first = 0; first < hours.size(); first += kLampLanes) {
        notify(progress, kLinkedPart + (1.0 - kLinkedPart) * double(first) / double(hours.size()));
        reflect(links, first, light);
    }
    LightOfHours found;
    const std::array<Mean, 2> typical = links.filter_outside(
        {std::move(light.halves[0]), std::move(light.halves[1]), std::move(sent)}, light.sky,
        light.sun);
    weigh(scene, light.of_sky, typical, found);
    found.light = std::move(light.sky);
    for (std::size_t m = 0; m < hours.size(); ++m)
        for (std::size_t i = 0; i < lumels; ++i)
            found.light[m][i] = glm::max(found.light[m][i], 0.0f) + glm::max(light.sun[m][i], 0.0f);
    return found;
}

}  // namespace lumel
