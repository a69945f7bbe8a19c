// Sky of a cloudless day. The luminance distribution is the CIE standard clear sky of low turbidity
// ([CIE03] type 12). Its level, and the sun's, are the mean of clear days by [IES84], with the
// elevation γ:
//
//     sky on a horizontal plane   0.8 + 15.5 √(sin γ)      [klx]
//     sun on a plane that faces it   127.5 exp(−0.21 / sin γ)   [klx]
//
// Its colour is the chromaticity of [PSS99] for turbidity 2.5: x and y have Perez' form, with Z the
// angle from the zenith and χ from the sun:
//
//     F(Z, χ) = (1 + A exp(B / cos Z)) (1 + C exp(D χ) + E cos²χ)
//     x = x_zenith F(Z, χ) / F(0, Z_sun)

#include "scene/sky/clear_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "base/core/luminance.h"
#include "scene/sky/cie_sky.h"

namespace lumel {
namespace {

constexpr int kClearWidth = 512;   ///< texels of 0.7°; the sky varies over 10°
constexpr int kClearHeight = 256;  ///< the lower half is the ground
constexpr int kClearType = 12;     ///< of the CIE
constexpr double kTurbidity = 2.5;
constexpr double kLux = 1000.0;  ///< per klx

/// A chromaticity coordinate of [PSS99]. Perez coefficients are slope × turbidity + offset; the
/// zenith is a cubic in the sun's angle with coefficients quadratic in turbidity.
struct Chromaticity {
    std::array<double, 5> slope;
    std::array<double, 5> offset;
    std::array<std::array<double, 4>, 3> zenith;  ///< [turbidity², turbidity, 1][θ³, θ², θ, 1]

    double perez(double cos_zenith, double from_sun) const
    {
        std::array<double, 5> p;
        for (std::size_t i = 0; i < p.size(); ++i)
            p[i] = slope[i] * kTurbidity + offset[i];
        const double cosine = std::cos(from_sun);
        return (1.0 + p[0] * std::exp(p[1] / cos_zenith)) *
               (1.0 + p[2] * std::exp(p[3] * from_sun) + p[4] * cosine * cosine);
    }

    double at_zenith(double sun_zenith) const
    {
        double value = 0.0;
        for (const std::array<double, 4>& row : zenith) {
            double cubic = 0.0;
            for (const double coefficient : row)
                cubic = cubic * sun_zenith + coefficient;
            value = value * kTurbidity + cubic;
        }
        return value;
    }

    double at(double cos_zenith, double from_sun, double sun_zenith) const
    {
        return at_zenith(sun_zenith) * perez(cos_zenith, from_sun) / perez(1.0, sun_zenith);
    }
};

constexpr Chromaticity kX{{-0.01925, -0.06651, -0.00041, -0.06409, -0.00325},
                          {-0.25922, 0.00081, 0.21247, -0.89887, 0.04517},
                          {{{0.00166, -0.00375, 0.00209, 0.0},
                            {-0.02903, 0.06377, -0.03202, 0.00394},
                            {0.11693, -0.21196, 0.06052, 0.25886}}}};
constexpr Chromaticity kY{{-0.01669, -0.09495, -0.00792, -0.04405, -0.01092},
                          {-0.26078, 0.00921, 0.21023, -1.65369, 0.05291},
                          {{{0.00275, -0.00610, 0.00317, 0.0},
                            {-0.04214, 0.08970, -0.04153, 0.00516},
                            {0.15346, -0.26756, 0.06670, 0.26688}}}};

/// Linear Rec. 709 of luminance 1, clipped to the gamut.
glm::vec3 color_of(double x, double y)
{
    const glm::dvec3 xyz(x / y, 1.0, (1.0 - x - y) / y);
    // IEC 61966-2-1, column-major.
    const glm::dmat3 rgb_from_xyz(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986,
                                  0.0415, 1.0570);
    const glm::vec3 rgb = glm::max(rgb_from_xyz * xyz, 0.0);
    return rgb / float(luminance(rgb));
}

}  // namespace

double clear_sky_illuminance(double elevation)
{
    return elevation <= 0.0 ? 0.0 : kLux * (0.8 + 15.5 * std::sqrt(std::sin(elevation)));
}

double sun_illuminance(double elevation)
{
    return elevation <= 0.0 ? 0.0 : kLux * 127.5 * std::exp(-0.21 / std::sin(elevation));
}

Sky clear_sky(const SunPosition& sun)
{
    Sky sky{.width = kClearWidth, .height = kClearHeight};
    sky.radiance.assign(std::size_t(kClearWidth) * kClearHeight, glm::vec3(0.0f));
    if (sun.elevation <= 0.0)
        return sky;
    const glm::dvec3 to_sun(direction_of(sun));
    const double sun_zenith = 0.5 * std::numbers::pi - sun.elevation;
    for (int row = 0; row < kClearHeight / 2; ++row)
        for (int column = 0; column < kClearWidth; ++column) {
            const double zenith = std::numbers::pi * (row + 0.5) / kClearHeight;
            const double phi = 2.0 * std::numbers::pi * (column + 0.5) / kClearWidth;
            const glm::dvec3 direction(-std::cos(phi) * std::sin(zenith), std::cos(zenith),
                                       -std::sin(phi) * std::sin(zenith));
            const double from_sun = std::acos(std::clamp(glm::dot(direction, to_sun), -1.0, 1.0));
            const glm::vec3 color = color_of(kX.at(direction.y, from_sun, sun_zenith),
                                             kY.at(direction.y, from_sun, sun_zenith));
            sky.radiance[std::size_t(row) * kClearWidth + std::size_t(column)] =
                float(cie_luminance(kClearType, direction.y, from_sun)) * color;
        }
    const auto level = float(clear_sky_illuminance(sun.elevation) / luminance(sky_irradiance(sky)));
    for (glm::vec3& radiance : sky.radiance)
        radiance *= level;
    return sky;
}

PunctualLight sun_light(const SunPosition& sun)
{
    PunctualLight light{.kind = PunctualLight::Kind::directional, .name = "sun"};
    light.intensity = float(sun_illuminance(sun.elevation));
    light.angle = kSunAngle;
    const glm::vec3 to_sun = direction_of(sun);
    // The disc is round, so any up vector that is not parallel will do.
    const glm::vec3 up = std::abs(to_sun.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    light.transform = glm::inverse(glm::lookAt(glm::vec3(0.0f), -to_sun, up));
    return light;
}

}  // namespace lumel
