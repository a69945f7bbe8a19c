#pragma once
// What a BRDF reflects, summed over a grid of directions.

#include <cmath>
#include <numbers>

#include "truth/brdf.h"

namespace lumel::support {

/// A unit direction about the normal (0, 0, 1).
inline glm::vec3 direction_of(double cosine, double angle)
{
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

/// f_r [1/sr] of a BRDF for light from a direction.
inline glm::vec3 value_of(const Brdf& brdf, const glm::vec3& incoming)
{
    return brdf.reflectance() * brdf.respond(incoming).shape / std::numbers::pi_v<float>;
}

/// Calls visit(ω, dω) for a grid of directions over the hemisphere about (0, 0, 1), with the solid
/// angle dω that each stands for.
template <typename Visit>
void for_hemisphere(const Visit& visit)
{
    constexpr int kRings = 1000, kSectors = 1000;
    for (int ring = 0; ring < kRings; ++ring) {
        // Even in θ, so that narrow lobes about the normal are met by many.
        const double step = 0.5 * std::numbers::pi / kRings, theta = (ring + 0.5) * step;
        const double solid_angle = step * std::sin(theta) * 2.0 * std::numbers::pi / kSectors;
        for (int sector = 0; sector < kSectors; ++sector)
            visit(direction_of(std::cos(theta), 2.0 * std::numbers::pi * (sector + 0.5) / kSectors),
                  solid_angle);
    }
}

/// ∫ g(ω) dω over that hemisphere; g returns a number.
template <typename Function>
double over_hemisphere(const Function& g)
{
    double sum = 0.0;
    for_hemisphere([&](const glm::vec3& direction, double solid_angle) {
        sum += solid_angle * double(g(direction));
    });
    return sum;
}

/// Share of the light that a surface of normal (0, 0, 1) reflects: ∫ f_r cosθ' dω', red.
inline double albedo_of(const Brdf& brdf)
{
    return over_hemisphere(
        [&](const glm::vec3& incoming) { return value_of(brdf, incoming).x * incoming.z; });
}

}  // namespace lumel::support
