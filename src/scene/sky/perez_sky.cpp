// With Z the angle of the sun from the zenith [rad], E_d the diffuse horizontal radiation, E_s that
// of the sun on a plane that faces it, E_0 that outside of the air, m the air mass:
//
//     ε = ((E_d + E_s) / E_d + 1.041 Z³) / (1 + 1.041 Z³)      clearness      [PISMS90] (1)
//     Δ = m E_d / E_0                                         brightness     [PISMS90] (2)
//
// Luminance at an angle ζ from the zenith and γ from the sun:
//
//     L ∝ (1 + a exp(b / cos ζ)) (1 + c exp(d γ) + e cos²γ)                   [PSM93] (1)
//     x = x₁ + x₂ Z + Δ (x₃ + x₄ Z)  for x = a, b, c, d, e                    [PSM93] (6)
//
// and in the first bin of ε   c = exp((Δ (c₁ + c₂ Z))^c₃) − c₄,
//                             d = −exp(Δ (d₁ + d₂ Z)) + d₃ + Δ d₄             [PSM93] (7), (8)
//
// Efficacy, with W = exp(0.07 T_d − 0.075) cm of precipitable water for the dew point T_d:
//
//     diffuse   a + b W + c cos Z + d ln Δ                                    [PISMS90] (7)
//     direct    max(0, a + b W + c exp(5.73 Z − 5) + d Δ)                     [PISMS90] (8)

#include "scene/sky/perez_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/trigonometric.hpp>

namespace lumel {
namespace {

constexpr std::size_t kBins = 8;
/// Lower bounds of ε but the first. [PISMS90] table 1
constexpr std::array<double, kBins - 1> kClearness = {1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2};
constexpr double kSolarConstant = 1367.0;  ///< [W/m²]

/// [PSM93] table 1.
struct PerezTerms {
    std::array<double, 4> a, b, c, d, e;
};
constexpr std::array<PerezTerms, kBins> kTerms = {{
    {{1.3525, -0.2576, -0.2690, -1.4366},
     {-0.7670, 0.0007, 1.2734, -0.1233},
     {2.8000, 0.6004, 1.2375, 1.0000},
     {1.8734, 0.6297, 0.9738, 0.2809},
     {0.0356, -0.1246, -0.5718, 0.9938}},
    {{-1.2219, -0.7730, 1.4148, 1.1016},
     {-0.2054, 0.0367, -3.9128, 0.9156},
     {6.9750, 0.1774, 6.4477, -0.1239},
     {-1.5798, -0.5081, -1.7812, 0.1080},
     {0.2624, 0.0672, -0.2190, -0.4285}},
    {{-1.1000, -0.2515, 0.8952, 0.0156},
     {0.2782, -0.1812, -4.5000, 1.1766},
     {24.7219, -13.0812, -37.7000, 34.8438},
     {-5.0000, 1.5218, 3.9229, -2.6204},
     {-0.0156, 0.1597, 0.4199, -0.5562}},
    {{-0.5484, -0.6654, -0.2672, 0.7117},
     {0.7234, -0.6219, -5.6812, 2.6297},
     {33.3389, -18.3000, -62.2500, 52.0781},
     {-3.5000, 0.0016, 1.1477, 0.1062},
     {0.4659, -0.3296, -0.0876, -0.0329}},
    {{-0.6000, -0.3566, -2.5000, 2.3250},
     {0.2937, 0.0496, -5.6812, 1.8415},
     {21.0000, -4.7656, -21.5906, 7.2492},
     {-3.5000, -0.1554, 1.4062, 0.3988},
     {0.0032, 0.0766, -0.0656, -0.1294}},
    {{-1.0156, -0.3670, 1.0078, 1.4051},
     {0.2875, -0.5328, -3.8500, 3.3750},
     {14.0000, -0.9999, -7.1406, 7.5469},
     {-3.4000, -0.1078, -1.0750, 1.5702},
     {-0.0672, 0.4016, 0.3017, -0.4844}},
    {{-1.0000, 0.0211, 0.5025, -0.5119},
     {-0.3000, 0.1922, 0.7023, -1.6317},
     {19.0000, -5.0000, 1.2438, -1.9094},
     {-4.0000, 0.0250, 0.3844, 0.2656},
     {1.0468, -0.3788, -2.4517, 1.4656}},
    {{-1.0500, 0.0289, 0.4260, 0.3590},
     {-0.3250, 0.1156, 0.7781, 0.0025},
     {31.0625, -14.5000, -46.1148, 55.3750},
     {-7.2312, 0.4050, 13.3500, 0.6234},
     {1.5000, -0.6426, 1.8564, 0.5636}},
}};

/// [PISMS90] table 4: a, b, c, d.
using Efficacy = std::array<double, 4>;
constexpr std::array<Efficacy, kBins> kDiffuseEfficacy = {{{97.24, -0.46, 12.00, -8.91},
                                                           {107.22, 1.15, 0.59, -3.95},
                                                           {104.97, 2.96, -5.53, -8.77},
                                                           {102.39, 5.59, -13.95, -13.90},
                                                           {100.71, 5.94, -22.75, -23.74},
                                                           {106.42, 3.83, -36.15, -28.83},
                                                           {141.88, 1.90, -53.24, -14.03},
                                                           {152.23, 0.35, -45.27, -7.98}}};
constexpr std::array<Efficacy, kBins> kDirectEfficacy = {{{57.20, -4.55, -2.98, 117.12},
                                                          {98.99, -3.46, -1.21, 12.38},
                                                          {109.83, -4.90, -1.71, -8.81},
                                                          {110.34, -5.84, -1.99, -4.56},
                                                          {106.36, -3.97, -1.75, -6.16},
                                                          {107.19, -1.25, -1.51, -26.73},
                                                          {105.75, 0.77, -1.26, -34.44},
                                                          {101.18, 1.58, -1.10, -8.29}}};

/// Optical air mass by F. Kasten, A. T. Young, Applied Optics 28(22), 1989.
double air_mass(double elevation)
{
    return 1.0 /
           (std::sin(elevation) + 0.50572 * std::pow(glm::degrees(elevation) + 6.07995, -1.6364));
}

/// Radiation of the sun outside of the air on a plane that faces it [W/m²]: the earth's distance
/// varies over the year.
double outside_of_air(int day_of_year)
{
    return kSolarConstant * (1.0 + 0.033 * std::cos(2.0 * std::numbers::pi * day_of_year / 365.0));
}

}  // namespace

PerezSky::PerezSky(const Radiation& radiation, const SunPosition& sun)
    : zenith_(0.5 * std::numbers::pi - std::max(sun.elevation, 0.0)),
      water_(std::exp(0.07 * radiation.dew_point - 0.075))
{
    const double cube = 1.041 * zenith_ * zenith_ * zenith_;
    const double diffuse = radiation.diffuse;
    // Bounds of the data of [PSM93], as in Radiance's gendaylit: beyond them the fit is negative.
    constexpr double kLeastBrightness = 0.01, kMostBrightness = 0.6, kMostClearness = 12.01;
    clearness_ =
        std::min(((diffuse + radiation.direct) / diffuse + cube) / (1.0 + cube), kMostClearness);
    brightness_ = std::clamp(air_mass(std::max(sun.elevation, 0.0)) * diffuse /
                                 outside_of_air(radiation.day_of_year),
                             kLeastBrightness, kMostBrightness);
    bin_ = std::size_t(std::upper_bound(kClearness.begin(), kClearness.end(), clearness_) -
                       kClearness.begin());
    // Minimum Δ of bins 1–4, as in gendaylit.
    constexpr double kLeastDelta = 0.2;
    constexpr std::size_t kFirstBin = 1, kLastBin = 4;
    double delta = brightness_;
    if (bin_ >= kFirstBin && bin_ <= kLastBin)
        delta = std::max(delta, kLeastDelta);
    const auto term = [&](const std::array<double, 4>& x) {
        return x[0] + x[1] * zenith_ + delta * (x[2] + x[3] * zenith_);
    };
    const PerezTerms& terms = kTerms[bin_];
    a_ = term(terms.a);
    b_ = term(terms.b);
    e_ = term(terms.e);
    if (bin_ == 0) {
        const auto& [c1, c2, c3, c4] = terms.c;
        const auto& [d1, d2, d3, d4] = terms.d;
        c_ = std::exp(std::pow(delta * (c1 + c2 * zenith_), c3)) - c4;
        d_ = -std::exp(delta * (d1 + d2 * zenith_)) + d3 + delta * d4;
    } else {
        c_ = term(terms.c);
        d_ = term(terms.d);
    }
}

double PerezSky::luminance(double cos_zenith, double from_sun) const
{
    const double cosine = std::cos(from_sun);
    return std::max((1.0 + a_ * std::exp(b_ / cos_zenith)) *
                        (1.0 + c_ * std::exp(d_ * from_sun) + e_ * cosine * cosine),
                    0.0);
}

double PerezSky::diffuse_efficacy() const
{
    const auto& [a, b, c, d] = kDiffuseEfficacy[bin_];
    return std::max(a + b * water_ + c * std::cos(zenith_) + d * std::log(brightness_), 0.0);
}

double PerezSky::direct_efficacy() const
{
    const auto& [a, b, c, d] = kDirectEfficacy[bin_];
    return std::max(a + b * water_ + c * std::exp(5.73 * zenith_ - 5.0) + d * brightness_, 0.0);
}

}  // namespace lumel
