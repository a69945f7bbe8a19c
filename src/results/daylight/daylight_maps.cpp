// 1. lumel_coefficients() of 145 patches and of positions of the sun, of low noise in the mean of
//    squares of charts.
// 2. These, times the strengths of hours, decide on the hours.
// 3. Their maps are solved for on their own, with the sun where it is, and those of a few other
//    hours, from which their sums differ by the error.

#include "results/daylight/daylight_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/core/luminance.h"
#include "links/trace/links.h"
#include "results/daylight/chosen_hours.h"
#include "results/daylight/light_of_hours.h"
#include "scene/sky/sky_patches.h"

namespace lumel {
namespace {

/// Side of the squares [texels]: fine noise is not in their means.
constexpr std::uint32_t kSquare = 8;
/// Part of the difference from a grid of the sun twice as wide that is the error of this: errors of
/// linear interpolation are as the square of the step.
constexpr double kOfWideError = 1.0 / 3.0;
/// Hours that tell the error of the sums: as many as links carry at once.
constexpr std::size_t kControls = kLampLanes;
/// Share of the work, for the progress bar only.
constexpr double kBeforeMaps = 0.5;

/// [hours][sources] Source strengths of each hour; grid: of the sun.
std::vector<float> strengths_of(const DaylightYear& year, DaylightYear::Sun::Grid grid)
{
    std::vector<float> strengths;
    for (std::size_t h = 0; h < year.hours(); ++h) {
        const std::vector<float> own = year.strengths(h, grid);
        strengths.insert(strengths.end(), own.begin(), own.end());
    }
    return strengths;
}

/// Sums of coefficients over the lumels of squares, by area.
class Squares {
public:
    Squares(const SolveScene& scene, std::size_t count) : scene_(scene), count_(count)
    {
        std::map<std::array<std::uint32_t, 4>, std::size_t> numbers;
        const std::uint32_t width = scene.lumels.width;
        for (const Lumel& lumel : scene.lumels.lumels) {
            const bool is_open = !(lumel.flags & kLumelBuried);
            of_lumel_.push_back(is_open ? numbers
                                              .try_emplace({lumel.chart, lumel.flags & kLumelBack,
                                                            lumel.texel % width / kSquare,
                                                            lumel.texel / width / kSquare},
                                                           numbers.size())
                                              .first->second
                                        : kNone);
        }
        sums_.resize(numbers.size() * count, glm::dvec3(0.0));
        areas_.resize(numbers.size(), 0.0);
        for (std::size_t i = 0; i < of_lumel_.size(); ++i)
            if (of_lumel_[i] != kNone)
                areas_[of_lumel_[i]] += double(scene.lumels.lumels[i].area);
    }

    /// Adds coefficients [N][count].
    void add(std::span<const glm::vec3> coefficients)
    {
        for (std::size_t i = 0; i < of_lumel_.size(); ++i)
            for (std::size_t k = 0; of_lumel_[i] != kNone && k < count_; ++k)
                sums_[of_lumel_[i] * count_ + k] +=
                    double(scene_.lumels.lumels[i].area) * glm::dvec3(coefficients[i * count_ + k]);
    }

    /// [3 squares][count] Means by the root of the area.
    std::vector<float> coefficients() const
    {
        std::vector<float> found;
        for (std::size_t square = 0; square < areas_.size(); ++square)
            for (int c = 0; c < 3; ++c)
                for (std::size_t k = 0; k < count_; ++k)
                    found.push_back(areas_[square] > 0.0 ? float(sums_[square * count_ + k][c] /
                                                                 std::sqrt(areas_[square]))
                                                         : 0.0f);
        return found;
    }

private:
    static constexpr std::size_t kNone = ~std::size_t(0);

    const SolveScene& scene_;
    std::vector<std::size_t> of_lumel_;  ///< [N]
    std::vector<glm::dvec3> sums_;       ///< [squares][count]
    std::vector<double> areas_;          ///< [squares]
    std::size_t count_;
};

/// Mean over the area of all surfaces [lx].
double mean_of(const SolveScene& scene, const Estimates& light)
{
    double sum = 0.0, area = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i)
        if (const Lumel& lumel = scene.lumels.lumels[i]; !(lumel.flags & kLumelBuried)) {
            sum += double(lumel.area) * luminance(light[i]);
            area += double(lumel.area);
        }
    return area > 0.0 ? sum / area : 0.0;
}

/// Hours with light that are not chosen, spread over the year.
std::vector<std::size_t> control_hours(const ChosenHours& chosen, const DaylightYear& year)
{
    std::vector<std::size_t> others;
    for (std::size_t h = 0; h < year.hours(); ++h)
        if (year.open_ground(h) > 0.0 &&
            std::find(chosen.hours.begin(), chosen.hours.end(), h) == chosen.hours.end())
            others.push_back(h);
    std::vector<std::size_t> controls;
    for (std::size_t k = 0; k < std::min(kControls, others.size()); ++k)
        controls.push_back(others[(2 * k + 1) * others.size() / (2 * kControls)]);
    return controls;
}

/// RMS error of sums of maps at lumels in the control hours, relative to that by `errors`, which
/// are of means of squares; at least 1. light: of the chosen hours, then of the controls.
double measured_by_stated(const SolveScene& scene, const ChosenHours& chosen,
                          std::span<const double> errors, std::span<const std::size_t> controls,
                          std::span<const Estimates> light)
{
    const std::size_t count = chosen.hours.size();
    double measured = 0.0, stated = 0.0;
    for (std::size_t k = 0; k < controls.size(); ++k) {
        const std::size_t hour = controls[k];
        double wrong = 0.0, all = 0.0;
        for (std::size_t i = 0; i < light[count + k].size(); ++i) {
            const double area = double(scene.lumels.lumels[i].area);
            glm::vec3 apart = light[count + k][i];
            all += area * double(glm::dot(apart, apart));
            for (std::size_t m = 0; m < count; ++m)
                apart -= chosen.weights[hour * count + m] * light[m][i];
            wrong += area * double(glm::dot(apart, apart));
        }
        measured += all > 0.0 ? wrong / all : 0.0;
        stated += errors[hour] * errors[hour];
    }
    return stated > 0.0 ? std::sqrt(std::max(measured / stated, 1.0)) : 1.0;
}

/// Root of the light in means of squares: direct light of the sky, reflected light of sky and sun.
std::vector<float> root_of_squares(const SolveScene& scene, const DaylightYear& year,
                                   const CoefficientRays& rays, const ProgressCallback& progress)
{
    const std::size_t patches = SkyPatches().count(), count = patches + year.sun_places().size();
    Squares squares(scene, count);
    squares.add(lumel_coefficients(
        scene, year.sun_places(), rays,
        [&](std::size_t, std::size_t source, const glm::vec3& direct, const glm::vec3& reflected) {
            return source < patches ? direct + reflected : reflected;
        },
        progress));
    return light_root(squares.coefficients(), std::uint32_t(count));
}

}  // namespace

std::uint64_t daylight_map_bytes(std::size_t lumels, std::size_t places, std::size_t texels)
{
    const std::uint64_t coefficients = lumel_coefficient_bytes(lumels, places);
    const std::uint64_t light = kMostDaylightMaps * lumels * sizeof(glm::vec3);
    const std::uint64_t hours = light_of_hours_bytes(lumels, kMostDaylightMaps + kControls);
    const std::uint64_t finished = light + kMostDaylightMaps * texels * sizeof(glm::vec4);
    return std::max({coefficients, hours, finished});
}

DaylightMaps daylight_maps(const SolveScene& scene, const DaylightYear& year,
                           const CoefficientRays& rays, const ProgressCallback& progress)
{
    const std::vector<float> root =
        root_of_squares(scene, year, rays, part_of(progress, 0.0, kBeforeMaps));
    const std::vector<float> strengths = strengths_of(year, &DaylightYear::Sun::near);
    const auto count = std::uint32_t(SkyPatches().count() + year.sun_places().size());
    ChosenHours chosen = choose_hours(root, strengths, count, kMapsError, kMostDaylightMaps);
    const std::vector<double> by_places =
        relative_difference(root, strengths, strengths_of(year, &DaylightYear::Sun::wide), count);
    if (chosen.hours.empty())
        return DaylightMaps{.mean = std::vector<double>(year.hours(), 0.0),
                            .errors = std::vector<double>(year.hours(), 0.0)};
    std::vector<double> errors;
    for (std::size_t h = 0; h < year.hours(); ++h)
        errors.push_back(std::hypot(chosen.errors[h], kOfWideError * by_places[h]));
    const std::vector<std::size_t> controls = control_hours(chosen, year);
    std::vector<std::size_t> solved = chosen.hours;
    solved.insert(solved.end(), controls.begin(), controls.end());
    LightOfHours light =
        light_of_hours(scene, year, solved, rays.seed, part_of(progress, kBeforeMaps, 1.0));
    const double more = measured_by_stated(scene, chosen, errors, controls, light.light);
    light.light.resize(chosen.hours.size());

    DaylightMaps maps{.hours = std::move(chosen.hours),
                      .light = std::move(light.light),
                      .weights = std::move(chosen.weights),
                      .mean = std::vector<double>(year.hours(), 0.0),
                      .error = chosen.error,
                      .errors = std::move(errors)};
    for (double& error : maps.errors)
        error = std::hypot(more * error, light.noise);
    for (std::size_t m = 0; m < maps.hours.size(); ++m) {
        const double mean = mean_of(scene, maps.light[m]);
        for (std::size_t h = 0; h < year.hours(); ++h)
            maps.mean[h] += mean * double(maps.weights[h * maps.hours.size() + m]);
    }
    return maps;
}

}  // namespace lumel
