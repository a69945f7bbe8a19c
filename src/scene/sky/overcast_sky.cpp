// Luminance at the elevation θ according to ISO 15469, type 16 (the traditional overcast sky):
//
//     L(θ) = L_z (1 + 2 sin θ) / 3
//
// The solid angle of a row of texels is proportional to its range of sin θ, so its mean radiance is
// that at its mean sin θ, exactly. The level makes the irradiance of the image exact too.

#include "scene/sky/overcast_sky.h"

#include <cmath>

#include <glm/gtc/constants.hpp>

#include "base/core/luminance.h"

namespace lumel {
namespace {

constexpr int kOvercastWidth = 64;  ///< independent of azimuth; as in a uniform sky
constexpr int kOvercastHeight =
    128;  ///< rows of 1.4°, over which the luminance varies by at most 2 %

double relative_luminance(double sine)
{
    return (1.0 + 2.0 * sine) / 3.0;
}

}  // namespace

Sky overcast_sky(float lux)
{
    Sky sky{.width = kOvercastWidth, .height = kOvercastHeight};
    sky.radiance.assign(std::size_t(kOvercastWidth) * kOvercastHeight, glm::vec3(0.0f));
    const auto sine_above = [](int row) {
        return std::cos(glm::pi<double>() * double(row) / kOvercastHeight);
    };
    for (int row = 0; row < kOvercastHeight / 2; ++row) {
        const double mean = 0.5 * (sine_above(row) + sine_above(row + 1));
        for (int column = 0; column < kOvercastWidth; ++column)
            sky.radiance[std::size_t(row) * kOvercastWidth + std::size_t(column)] =
                glm::vec3(float(relative_luminance(mean)));
    }
    const auto level = float(double(lux) / luminance(glm::vec3(sky_irradiance(sky))));
    for (glm::vec3& radiance : sky.radiance)
        radiance *= level;
    return sky;
}

}  // namespace lumel
