// 1. lumel_coefficients() of 145 patches and of positions of the sun, at lumels of a coarser atlas.
// 2. These, times the strengths of hours, decide on the hours.
// 3. Their maps are solved for on their own, with the sun where it is, and those of a few other
//    hours, from which their sums differ by the error.

#include "results/daylight/daylight_maps.h"

#include <algorithm>
#include <cmath>

#include "base/core/luminance.h"
#include "links/trace/links.h"
#include "results/daylight/chosen_hours.h"
#include "results/daylight/error_weights.h"
#include "results/daylight/light_of_hours.h"
#include "results/daylight/lumel_coefficients.h"
#include "scene/sky/sky_patches.h"

namespace lumel {
namespace {

/// Maximum width of the lumels that decide on the hours, relative to those of the maps, and about
/// their minimum number.
constexpr double kCoarser = 8.0, kLeastCoarse = 4096.0;
/// Part of the difference from a grid of the sun twice as wide that is the error of this: errors of
/// linear interpolation are as the square of the step.
constexpr double kOfWideError = 1.0 / 3.0;
/// Hours that tell the error of the sums: as many as links carry at once.
constexpr std::size_t kControls = kLampLanes;
/// Share of the work, for the progress bar only.
constexpr double kCoarseReady = 0.02, kBeforeMaps = 0.1;

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

/// The same scene with lumels up to kCoarser times as wide. options: of its atlas.
SolveScene coarser(const SolveScene& fine, AtlasOptions options, const ProgressCallback& progress)
{
    const auto wider = float(
        std::clamp(std::sqrt(double(fine.lumels.lumels.size()) / kLeastCoarse), 1.0, kCoarser));
    options.texels_per_metre = fine.atlas.texels_per_metre / wider;
    options.size = 0;
    options.max_size = std::max(AtlasOptions().max_size, fine.atlas.width);
    options.pages = 1;
    options.gutter = std::min(options.gutter, AtlasOptions().gutter);
    Scene scene = fine.scene;
    for (DensityRule& rule : options.densities)
        rule.texels_per_metre /= wider;
    for (Instance& instance : scene.instances)
        instance.texels_per_metre /= wider;
    for (Material& material : scene.materials)
        material.texels_per_metre /= wider;
    return SolveScene(std::move(scene), options, progress);
}

/// The more lumels, the fewer rays each needs: all of them decide.
CoefficientRays rays_of(std::size_t lumels, std::uint32_t seed)
{
    const auto share = [&](std::size_t rays, std::size_t least, std::size_t most) {
        return std::uint32_t(std::clamp(rays / (lumels + 1), least, most));
    };
    return {.sky = share(4'000'000, 256, 2048), .links = share(2'000'000, 128, 1024), .seed = seed};
}

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
/// are of coarser lumels; at least 1. light: of the chosen hours, then of the controls.
double measured_by_stated(const ChosenHours& chosen, std::span<const double> errors,
                          std::span<const std::size_t> controls, const LightOfHours& found)
{
    const std::size_t count = chosen.hours.size();
    const std::vector<Estimates>& light = found.light;
    double measured = 0.0, stated = 0.0;
    for (std::size_t k = 0; k < controls.size(); ++k) {
        const std::size_t hour = controls[k];
        double wrong = 0.0, all = 0.0;
        for (std::size_t i = 0; i < light[count + k].size(); ++i) {
            const double weight = double(found.weights[i]);
            glm::vec3 apart = light[count + k][i];
            all += weight * double(glm::dot(apart, apart));
            for (std::size_t m = 0; m < count; ++m)
                apart -= chosen.weights[hour * count + m] * light[m][i];
            wrong += weight * double(glm::dot(apart, apart));
        }
        measured += all > 0.0 ? wrong / all : 0.0;
        stated += errors[hour] * errors[hour];
    }
    return stated > 0.0 ? std::sqrt(std::max(measured / stated, 1.0)) : 1.0;
}

/// [sources] Strengths in a typical hour: the sum of all, each relative to its open ground.
std::vector<double> typical_strengths(const DaylightYear& year, std::span<const float> strengths)
{
    const std::size_t count = strengths.size() / year.hours();
    std::vector<double> typical(count, 0.0);
    for (std::size_t h = 0; h < year.hours(); ++h) {
        const double lux = year.open_ground(h);
        for (std::size_t k = 0; k < count && lux > 0.0; ++k)
            typical[k] += double(strengths[h * count + k]) / lux;
    }
    return typical;
}

/// Root of direct light of the sky and of reflected light of sky and sun at the lumels, with their
/// error_weights(). strengths [hours][sources].
std::vector<float> root_of(const SolveScene& scene, const DaylightYear& year,
                           std::span<const float> strengths, std::uint32_t seed,
                           const ProgressCallback& progress)
{
    const std::size_t lumels = scene.lumels.lumels.size(), patches = SkyPatches().count();
    const std::vector<double> typical = typical_strengths(year, strengths);
    std::vector<float> of_sky(lumels, 0.0f), light(lumels, 0.0f);
    const std::vector<glm::vec3> found = lumel_coefficients(
        scene, year.sun_places(), rays_of(lumels, seed),
        [&](std::size_t i, std::size_t source, const glm::vec3& direct,
            const glm::vec3& reflected) {
            const bool is_sky = source < patches;
            of_sky[i] += is_sky ? float(luminance(direct)) : 0.0f;
            const glm::vec3 both = is_sky ? direct + reflected : reflected;
            light[i] += float(typical[source] * luminance(both));
            return both;
        },
        progress);
    const std::vector<float> weights = error_weights(scene, light, sees_sky(of_sky));
    std::vector<float> rows;  // of red, green and blue at each lumel
    rows.reserve(3 * found.size());
    for (std::size_t i = 0; i < lumels; ++i)
        for (int c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < typical.size(); ++k)
                rows.push_back(std::sqrt(weights[i]) * found[i * typical.size() + k][c]);
    return light_root(rows, std::uint32_t(typical.size()));
}

}  // namespace

std::uint64_t daylight_map_bytes(const SolveScene& scene, std::size_t places,
                                 std::uint64_t scene_bytes)
{
    // Charts have a lumel at least, and at their rims some more.
    constexpr std::size_t kOfChart = 2;
    const std::size_t lumels = scene.lumels.lumels.size(),
                      texels = std::size_t(scene.atlas.width) * std::size_t(scene.atlas.height);
    const std::size_t coarse =
        std::min(lumels, std::size_t(kLeastCoarse + double(lumels) / (kCoarser * kCoarser)) +
                             kOfChart * scene.atlas.chart_count);
    const std::uint64_t coefficients = scene_bytes + lumel_coefficient_bytes(coarse, places);
    const std::uint64_t light = kMostDaylightMaps * lumels * sizeof(glm::vec3);
    const std::uint64_t hours = light_of_hours_bytes(lumels, kMostDaylightMaps + kControls);
    const std::uint64_t finished = light + kMostDaylightMaps * texels * sizeof(glm::vec4);
    return std::max({coefficients, hours, finished});
}

DaylightMaps daylight_maps(const SolveScene& scene, const AtlasOptions& options,
                           const DaylightYear& year, std::uint32_t seed,
                           const ProgressCallback& progress)
{
    notify(progress, 0.0);
    const std::vector<float> strengths = strengths_of(year, &DaylightYear::Sun::near);
    const std::vector<float> root =
        root_of(coarser(scene, options, part_of(progress, 0.0, kCoarseReady)), year, strengths,
                seed, part_of(progress, kCoarseReady, kBeforeMaps));
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
        light_of_hours(scene, year, solved, seed, part_of(progress, kBeforeMaps, 1.0));
    const double more = measured_by_stated(chosen, errors, controls, light);
    light.light.resize(chosen.hours.size());

    DaylightMaps maps{.hours = std::move(chosen.hours),
                      .light = std::move(light.light),
                      .weights = std::move(chosen.weights),
                      .mean = std::vector<double>(year.hours(), 0.0),
                      .lumel_weights = std::move(light.weights),
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
