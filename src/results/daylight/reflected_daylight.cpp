// Of direct light D and reflected light X, a surface of albedo ρ sends
//
//     B = ρ (D + X)

#include "results/daylight/reflected_daylight.h"

namespace lumel {
namespace {

/// Fraction of the work before light is reflected, for the progress bar only.
constexpr double kBeforeReflection = 0.7;

std::function<bool(double)> part_of(const std::function<bool(double)>& progress, double from,
                                    double to)
{
    return [&progress, from, to](double part) {
        return !progress || progress(from + (to - from) * part);
    };
}

}  // namespace

ReflectedDaylight::ReflectedDaylight(const SolveScene& scene, std::span<const glm::vec3> places,
                                     const DaylightTransportOptions& options,
                                     const std::function<bool(double)>& progress)
    : transport_(scene, places, options, part_of(progress, 0.0, kBeforeReflection))
{
    transport_.reflect(
        [&](std::size_t i, const glm::vec3& direct, const glm::vec3& reflected) {
            return scene.lumels.lumels[i].albedo * (direct + reflected);
        },
        part_of(progress, kBeforeReflection, 1.0));
}

}  // namespace lumel
