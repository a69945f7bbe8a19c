#include "jobs/bake/advice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "atlas/near/still_part.h"
#include "base/core/luminance.h"
#include "jobs/bake/seen_backs.h"
#include "scene/values/sky.h"
#include "solve/solver/solver.h"

namespace lumel {
namespace {

/// Above these fractions of the lumels, advice is given on an object, on back sides, and on lumels
/// without light.
constexpr double kMuch = 0.6, kManyBacks = 0.4, kMuchDark = 1.0 / 3.0;
/// Of an object's area from above, what others stand on if it reaches far beyond them.
constexpr double kSmallPart = 0.25;
/// Scenes of fewer objects get no advice on them.
constexpr std::size_t kFewObjects = 4;
constexpr std::size_t kMostSentences = 3;
/// Names in one sentence.
constexpr std::size_t kMostNames = 3;
/// A clear sky gives about a tenth of the sun's light, a hazy one more.
constexpr double kDarkSky = 0.02;

/// False if the scene has no light sources; the reader has warned then.
bool has_sources(const SolveScene& prepared)
{
    const std::vector<Lumel>& lumels = prepared.lumels.lumels;
    return has_lights(prepared.scene) ||
           std::any_of(lumels.begin(), lumels.end(),
                       [](const Lumel& lumel) { return lumel.emission != glm::vec3(0.0f); });
}

std::string percent(double fraction)
{
    return fmt::format("{:.0f} %", 100.0 * fraction);
}

/// Area of a box seen from above [m²].
double area_from_above(const MovedBox& box)
{
    const glm::dvec3 size = glm::max(box.high - box.low, glm::vec3(0.0f));
    return size.x * size.z;
}

/// True if all other objects stand on a small part of this one, as a house on its lawn; not if it
/// is the room that they stand in.
bool reaches_far_beyond(const Scene& scene, std::uint32_t instance)
{
    constexpr float kFar = std::numeric_limits<float>::max();
    MovedBox others{glm::vec3(kFar), glm::vec3(-kFar)};
    const auto box = [&](std::uint32_t i) {
        return box_of(scene, i, scene.instances[i].transform);
    };
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (i != instance) {
            const MovedBox other = box(i);
            others.low = glm::min(others.low, other.low);
            others.high = glm::max(others.high, other.high);
        }
    return area_from_above(others) < kSmallPart * area_from_above(box(instance));
}

/// The object with most lumels, if it has too many.
std::string of_objects(const SolveScene& prepared, const AtlasOptions& chosen)
{
    const std::vector<Instance>& instances = prepared.scene.instances;
    const bool is_chosen = chosen.coarse_afar || !chosen.densities.empty();
    if (instances.size() < kFewObjects || is_chosen || chosen.texels_per_metre > 0.0f)
        return {};
    std::vector<std::size_t> lumels(instances.size(), 0);
    for (const Lumel& lumel : prepared.lumels.lumels)
        ++lumels[lumel.instance];
    const auto most = std::max_element(lumels.begin(), lumels.end());
    const double share = double(*most) / double(prepared.lumels.lumels.size());
    const auto largest = std::uint32_t(most - lumels.begin());
    const std::string& name = instances[largest].name;
    if (!(share > kMuch) || name.empty() || !reaches_far_beyond(prepared.scene, largest))
        return {};
    return fmt::format("\"{}\" has {} of the lumels; --coarse-afar or --density \"{}={:.3g}\" "
                       "leaves more of them to the rest",
                       name, percent(share), name, 0.5 * double(prepared.atlas.texels_per_metre));
}

std::string of_back_sides(const SolveScene& prepared)
{
    const std::vector<Lumel>& lumels = prepared.lumels.lumels;
    const auto backs = std::count_if(lumels.begin(), lumels.end(), [](const Lumel& lumel) {
        return (lumel.flags & kLumelBack) != 0 && (lumel.flags & kLumelBuried) == 0;
    });
    const double share = double(backs) / double(std::max<std::size_t>(lumels.size(), 1));
    if (!(share > kManyBacks))
        return {};
    return fmt::format("{} of the lumels are on back sides of double-sided materials; where nobody "
                       "sees those, single-sided materials (in Blender: Backface Culling) bake "
                       "faster",
                       percent(share));
}

std::string of_daylight(const Scene& scene)
{
    const double sky = luminance(glm::vec3(sky_irradiance(scene.sky)));
    double sun = 0.0;
    for (const PunctualLight& light : scene.lights)
        if (light.kind == PunctualLight::Kind::directional) {
            const double up = double(glm::normalize(glm::vec3(light.transform[2])).y);
            sun += luminance(light.intensity * light.color) * std::max(up, 0.0);
        }
    if (!(sky < kDarkSky * sun))
        return {};
    return fmt::format("the sky gives {} lx on open ground and the sun {:.0f} lx, so shadows are "
                       "nearly black; outdoors a sky gives about a tenth of the sun, see --sky and "
                       "--sky-scale",
                       sky < 10.0 ? fmt::format("{:.2g}", sky) : fmt::format("{:.0f}", sky), sun);
}

}  // namespace

std::vector<std::string> advice(const SolveScene& prepared, const AtlasOptions& chosen)
{
    std::vector<std::string> sentences{of_seen_backs(prepared), of_daylight(prepared.scene),
                                       of_objects(prepared, chosen), of_back_sides(prepared)};
    std::erase(sentences, std::string());
    sentences.resize(std::min(sentences.size(), kMostSentences));
    return sentences;
}

std::string of_dark_lumels(const SolveScene& prepared, const AtlasOptions& chosen,
                           const std::vector<glm::vec3>& irradiance)
{
    const std::vector<Lumel>& lumels = prepared.lumels.lumels;
    const std::vector<Instance>& instances = prepared.scene.instances;
    std::vector<std::size_t> dark_of(instances.size(), 0);
    std::size_t dark = 0;
    for (std::size_t i = 0; i < lumels.size(); ++i)
        if (irradiance[i] == glm::vec3(0.0f)) {
            ++dark_of[lumels[i].instance];
            ++dark;
        }
    const double share = double(dark) / double(std::max<std::size_t>(lumels.size(), 1));
    if (!(share > kMuchDark) || dark == lumels.size())
        return {};
    const auto most = std::max_element(dark_of.begin(), dark_of.end());
    const std::string& name = instances[std::size_t(most - dark_of.begin())].name;
    const std::string on = name.empty() ? ""
                                        : fmt::format(", {} of them on \"{}\"",
                                                      percent(double(*most) / double(dark)), name);
    const std::string gain =
        chosen.texels_per_metre > 0.0f
            ? "the bake takes less time and memory"
            : fmt::format("the rest has up to {:.1f} times the texels per metre at the same size",
                          std::sqrt(1.0 / (1.0 - share)));
    return fmt::format("{} of the lumels get no light{}; without faces that are never seen, such "
                       "as the outside of a room, {}",
                       percent(share), on, gain);
}

std::string where_it_is_noisy(const Scene& scene, const std::vector<NoisySurface>& surfaces)
{
    std::string names;
    std::size_t named = 0;
    for (const NoisySurface& surface : surfaces) {
        const std::string& name = scene.instances[surface.instance].name;
        if (named == kMostNames || name.empty())
            continue;
        names +=
            fmt::format("{}\"{}\" ({:.1f} %)", named > 0 ? ", " : "", name, 100.0 * surface.noise);
        ++named;
    }
    if (named == 0)
        return {};
    if (surfaces.size() > named)
        names += fmt::format(" and {} more", surfaces.size() - named);
    return "noise may still be seen on " + names + "; see the errors in the page of lumel report";
}

bool is_lit(const std::vector<glm::vec3>& irradiance)
{
    return std::any_of(irradiance.begin(), irradiance.end(),
                       [](const glm::vec3& light) { return light != glm::vec3(0.0f); });
}

void tell_advice(const SolveScene& prepared, const BakeOptions& options, const Solution& solution,
                 Stages& stages)
{
    if (!is_lit(solution.irradiance) && has_sources(prepared))
        stages.warn("no light reaches any surface: the lightmap is black");
    std::vector<std::string> sentences = advice(prepared, options.atlas);
    if (options.parts == Parts::all)
        sentences.push_back(of_dark_lumels(prepared, options.atlas, solution.irradiance));
    if (solution.solver->state().visible_noise.worst_chart >
        options.solver.target_quality.visible_noise)
        sentences.push_back(where_it_is_noisy(prepared.scene, solution.solver->noisy_surfaces()));
    std::erase(sentences, "");
    for (const std::string& sentence : sentences)
        stages.tell(sentence);
}

}  // namespace lumel
