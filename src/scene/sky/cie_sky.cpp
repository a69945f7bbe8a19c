// Standard general skies [CIE03], with Z the angle from the zenith and χ from the sun:
//
//     L ∝ (1 + a exp(b / cos Z)) (1 + c (exp(d χ) − exp(d π/2)) + e cos²χ)
//
// and, as type 16, the traditional overcast sky: L ∝ 1 + 2 cos Z.
//
// The solid angle of a row of texels is proportional to its range of cos Z, so texels have the
// luminance at their mean cos Z. For type 16 this is exact. The level makes the irradiance of the
// image exact.

#include "scene/sky/cie_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

#include "base/core/luminance.h"

namespace lumel {
namespace {

/// Texels of 0.7°, over which the brightest sky varies by a few per cent; for skies that depend on
/// height alone, columns are as few as in a uniform sky.
constexpr int kCieHeight = 256, kCieWidth = 512, kWidthOfEven = 64;

struct Distribution {
    double a, b, c, d, e;
};

constexpr std::array<Distribution, 15> kDistributions = {{
    {4.0, -0.70, 0.0, -1.0, 0.00},    // 1: overcast, steep gradation
    {4.0, -0.70, 2.0, -1.5, 0.15},    // 2: the same, slightly brighter towards the sun
    {1.1, -0.80, 0.0, -1.0, 0.00},    // 3: overcast, moderate gradation
    {1.1, -0.80, 2.0, -1.5, 0.15},    // 4: the same, slightly brighter towards the sun
    {0.0, -1.00, 0.0, -1.0, 0.00},    // 5: uniform
    {0.0, -1.00, 2.0, -1.5, 0.15},    // 6: partly cloudy, slightly brighter towards the sun
    {0.0, -1.00, 5.0, -2.5, 0.30},    // 7: the same, brighter about the sun
    {0.0, -1.00, 10.0, -3.0, 0.45},   // 8: the same, with a corona
    {-1.0, -0.55, 2.0, -1.5, 0.15},   // 9: partly cloudy, with a hidden sun
    {-1.0, -0.55, 5.0, -2.5, 0.30},   // 10: the same, brighter about the sun
    {-1.0, -0.55, 10.0, -3.0, 0.45},  // 11: white-blue, with a corona
    {-1.0, -0.32, 10.0, -3.0, 0.45},  // 12: clear, low turbidity
    {-1.0, -0.32, 16.0, -3.0, 0.30},  // 13: clear, polluted
    {-1.0, -0.15, 16.0, -3.0, 0.30},  // 14: cloudless, turbid, with a broad corona
    {-1.0, -0.15, 24.0, -2.8, 0.15},  // 15: the same, white-blue
}};

const Distribution& distribution(int type)
{
    return kDistributions[std::size_t(type) - 1];
}

}  // namespace

bool is_overcast(int type)
{
    constexpr int kStandardOvercast = 1;
    return type == kStandardOvercast || type == kOvercastType;
}

bool depends_on_sun(int type)
{
    return type != kOvercastType && (distribution(type).c != 0.0 || distribution(type).e != 0.0);
}

double cie_luminance(int type, double cos_zenith, double from_sun)
{
    if (type == kOvercastType)
        return 1.0 + 2.0 * cos_zenith;
    const Distribution& is = distribution(type);
    const double cosine = std::cos(from_sun);
    const double corona = std::exp(is.d * from_sun) - std::exp(0.5 * std::numbers::pi * is.d);
    return (1.0 + is.a * std::exp(is.b / cos_zenith)) *
           (1.0 + is.c * corona + is.e * cosine * cosine);
}

Sky image_of(const CieSky& wanted)
{
    const bool with_sun = depends_on_sun(wanted.type);
    const glm::dvec3 to_sun =
        with_sun ? glm::dvec3(direction_of(wanted.sun.value())) : glm::dvec3(0.0, 1.0, 0.0);
    Sky sky{.width = with_sun ? kCieWidth : kWidthOfEven, .height = kCieHeight};
    sky.radiance.assign(std::size_t(sky.width) * kCieHeight, glm::vec3(0.0f));
    const auto cos_above = [](int row) { return std::cos(std::numbers::pi * row / kCieHeight); };
    for (int row = 0; row < kCieHeight / 2; ++row) {
        const double cosine = 0.5 * (cos_above(row) + cos_above(row + 1));
        const double sine = std::sqrt(1.0 - cosine * cosine);
        for (int column = 0; column < sky.width; ++column) {
            const double phi = 2.0 * std::numbers::pi * (column + 0.5) / sky.width;
            const glm::dvec3 direction(-std::cos(phi) * sine, cosine, -std::sin(phi) * sine);
            const double from_sun = std::acos(std::clamp(glm::dot(direction, to_sun), -1.0, 1.0));
            sky.radiance[std::size_t(row) * std::size_t(sky.width) + std::size_t(column)] =
                glm::vec3(float(cie_luminance(wanted.type, cosine, from_sun)));
        }
    }
    const auto level = float(double(wanted.lux) / luminance(glm::vec3(sky_irradiance(sky))));
    for (glm::vec3& radiance : sky.radiance)
        radiance *= level;
    return sky;
}

}  // namespace lumel
