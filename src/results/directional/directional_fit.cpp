// Spherical harmonics fitted to irradiance on the visible side of a surface.
//
// [RH01] R. Ramamoorthi, P. Hanrahan. An Efficient Representation for Irradiance Environment Maps.
//        SIGGRAPH 2001.
//
// The projection c_lm = ∫ L Y_lm of radiance over the sphere spends most of the accuracy of one or
// two bands on the horizon, below which no light arrives. The aim is irradiance,
//
//     H(n') = ∫ L(ω) max(ω·n', 0) dω   ≈   Σ A_l c_lm Y_lm(n'),            [RH01] Eq. (5), (8)
//
// for normals n' on the upper side of the surface's own normal n. The coefficients of light L are
// therefore the linear functions c_lm = ∫ L(ω) D_lm(ω) dω that minimise
//
//     ∫ (n·n') (Σ A_l D_lm Y_lm(n') - max(ω·n', 0))² dn'  +  λ Σ (D_lm - Y_lm(ω))²
//
// over the upper hemisphere, with Σ A_l D_lm Y_lm(n) = max(ω·n, 0) at n itself. λ keeps them near
// the projection, so that they still describe the incoming radiance. With n along z, D_lm is a
// function of ω's elevation times cos |m|φ or sin |m|φ: tabulated here, combined in
// directional.glsl.
//
// Measured with rays on the Cornell box (cosine-weighted normals, matched at n): RMS errors of H at
// normals tilted by 20° and 40° fall from 11 % and 24 % to 5 % and 10 % for one band beyond the
// mean, and from 4.3 % and 7.9 % to 3.4 % and 5.2 % for two.

#include "results/directional/directional_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/core/frame.h"

namespace lumel {
namespace {

using Vector = glm::dvec3;  // over the bands
using Matrix = glm::dmat3;

/// λ. From 0 to 0.1 the irradiance gets 1.7 times worse at two bands and reflections better; below
/// 0.03 more than 1 % of lumels receive more from one side than in total.
constexpr double kPull = 0.03;
/// Integration steps over normals, in height and azimuth.
constexpr int kHeights = 64, kAround = 128;
/// Elevations closer to the poles have no tangential part.
constexpr double kPole = 1e-4;
/// Maximum scaling to the known irradiance.
constexpr float kMaxScale = 2.0f;
/// Normals with irradiance ≥ 0: rings at these tilts [degrees].
constexpr float kRings[] = {15.0f, 30.0f, 45.0f, 60.0f};
constexpr int kRingNormals = 16;

double y0(int band, double z)
{
    return band == 0 ? double(kY0)
                     : (band == 1 ? double(kY1) * z : double(kY20) * (3.0 * z * z - 1.0));
}

/// Y_lm of (s, 0, z), m ≥ 0.
double harmonic(int band, int m, double s, double z)
{
    if (m == 0)
        return y0(band, z);
    if (m == 1)
        return band == 1 ? double(kY1) * s : double(kY2) * s * z;
    return double(kY22) * s * s;
}

double lobe(int band)
{
    return double(kCosineLobe[std::size_t(band)]);
}

/// Least-squares matrix of the bands m…order for azimuthal order m.
Matrix normal_matrix(int m, int order)
{
    Matrix matrix(1.0);  // unused bands stay 0
    for (int a = m; a <= order; ++a)
        for (int b = m; b <= order; ++b) {
            double sum = a == b ? kPull : 0.0;
            for (int i = 0; i < kHeights; ++i) {
                const double z = (i + 0.5) / kHeights, s = std::sqrt(1.0 - z * z);
                // ∫ cos² mφ dφ is 2π for m = 0, else π.
                const double ring = (m == 0 ? 2.0 : 1.0) * std::numbers::pi / kHeights;
                sum += z * ring * lobe(a) * lobe(b) * harmonic(a, m, s, z) * harmonic(b, m, s, z);
            }
            matrix[b][a] = sum;
        }
    return matrix;
}

/// Right-hand side for light from (s, 0, z).
Vector target(int m, int order, double s, double z)
{
    Vector sum(0.0);
    for (int i = 0; i < kHeights; ++i) {
        const double nz = (i + 0.5) / kHeights, ns = std::sqrt(1.0 - nz * nz);
        double round = 0.0;
        for (int k = 0; k < kAround; ++k) {
            const double angle = 2.0 * std::numbers::pi * (k + 0.5) / kAround;
            round += std::max(s * ns * std::cos(angle) + z * nz, 0.0) * std::cos(m * angle);
        }
        const double weight = nz * round * 2.0 * std::numbers::pi / (kHeights * kAround);
        for (int l = m; l <= order; ++l)
            sum[l] += weight * lobe(l) * harmonic(l, m, ns, nz);
    }
    for (int l = m; l <= order; ++l)
        sum[l] += kPull * harmonic(l, m, s, z);
    return sum;
}

/// A_l Y_l0(n): irradiance at the surface's own normal per coefficient.
Vector at_normal(int order)
{
    Vector result(0.0);
    for (int l = 0; l <= order; ++l)
        result[l] = lobe(l) * y0(l, 1.0);
    return result;
}

}  // namespace

DirectionalFit::DirectionalFit(int order) : order_(order), rows_(kElevations)
{
    Matrix inverse[kMaxBands];
    for (int m = 0; m <= order; ++m)
        inverse[m] = glm::inverse(normal_matrix(m, order));

    // The smallest change that adds irradiance 1 at n.
    const Vector own = at_normal(order);
    const Vector change = inverse[0] * own / glm::dot(own, inverse[0] * own);
    for (int l = 0; l <= order; ++l)
        spread_[std::size_t(l)] = float(change[l] / y0(l, 1.0));

    for (std::uint32_t i = 0; i < kElevations; ++i) {
        const double height = 2.0 * i / (kElevations - 1) - 1.0;
        const double z = std::clamp(height, kPole - 1.0, 1.0 - kPole);
        const double s = std::sqrt(1.0 - z * z);
        Vector d[kMaxBands] = {};
        for (int m = 0; m <= order; ++m)
            d[m] = inverse[m] * target(m, order, s, z);
        d[0] += change * (std::max(height, 0.0) - glm::dot(own, d[0]));
        FitRow& row = rows_[i];
        row.zero = float(d[0][0]);
        row.along = float(d[0][1]);
        row.across = float(d[1][1] / s);
        row.axial = float(d[0][2] / (2.0 * double(kY20)));
        row.skew = float(d[1][2] / (double(kY2) * s));
        row.planar = float(d[2][2] / (double(kY22) * s * s));
    }
}

/// As in directional.glsl.
std::array<float, kMaxCoefficients> DirectionalFit::coefficients_of(const glm::vec3& from,
                                                                    const glm::vec3& n) const
{
    const float z = glm::dot(n, from);
    const float at = std::clamp(0.5f * z + 0.5f, 0.0f, 1.0f) * float(kElevations - 1);
    const std::size_t row = std::min(std::size_t(at), std::size_t(kElevations - 2));
    const FitRow &a = rows_[row], &b = rows_[row + 1];
    const float part = at - float(row);
    const auto mixed = [&](float FitRow::*of) { return a.*of + part * (b.*of - a.*of); };
    const glm::vec3 t = from - z * n;
    const glm::vec3 u = mixed(&FitRow::along) * n + mixed(&FitRow::across) * t;
    std::array<float, kMaxCoefficients> c{mixed(&FitRow::zero), u.y, u.z, u.x};
    if (order_ < 2)
        return c;
    const float skew = mixed(&FitRow::skew), planar = mixed(&FitRow::planar);
    const float axial = mixed(&FitRow::axial), even = 0.5f * planar * glm::dot(t, t);
    const glm::mat3 m = (axial + even) * glm::outerProduct(n, n) +
                        skew * (glm::outerProduct(n, t) + glm::outerProduct(t, n)) +
                        planar * glm::outerProduct(t, t) - (axial / 3.0f + even) * glm::mat3(1.0f);
    c[4] = kY2 * m[0][1];
    c[5] = kY2 * m[1][2];
    c[6] = 3.0f * kY20 * m[2][2];
    c[7] = kY2 * m[0][2];
    c[8] = kY22 * (m[0][0] - m[1][1]);
    return c;
}

void DirectionalFit::match(std::span<glm::vec3> coefficients, const glm::vec3& normal,
                           const glm::vec3& irradiance) const
{
    const glm::vec3 gap = irradiance - irradiance_at(coefficients, normal);
    const auto y = harmonics(normal);
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        coefficients[i] += spread_[std::size_t(band_of(int(i)))] * y[i] * gap;
}

namespace {

/// Normals on rings about `axis`.
std::vector<glm::vec3> rings_about(const glm::vec3& axis)
{
    const glm::mat3 frame = frame_about(axis);
    std::vector<glm::vec3> normals;
    for (const float ring : kRings)
        for (int k = 0; k < kRingNormals; ++k) {
            const float tilt = glm::radians(ring);
            const float angle = 2.0f * std::numbers::pi_v<float> * float(k) / float(kRingNormals);
            normals.push_back(frame * glm::vec3(std::sin(tilt) * std::cos(angle),
                                                std::sin(tilt) * std::sin(angle), std::cos(tilt)));
        }
    return normals;
}

/// Part of the coefficients that is symmetric about the axis.
std::array<glm::vec3, kMaxCoefficients> axial_part(std::span<const glm::vec3> coefficients,
                                                   const glm::vec3& axis)
{
    // Σ_m c_lm Y_lm(axis) is the value of the band along the axis; Y_l0(1)² = Σ_m Y_lm(axis)².
    const auto y = harmonics(axis);
    std::array<glm::vec3, kMaxBands> along{};
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        along[std::size_t(band_of(int(i)))] += coefficients[i] * y[i];
    std::array<glm::vec3, kMaxCoefficients> part{};
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        const int band = band_of(int(i));
        const auto pole = float(y0(band, 1.0));
        part[i] = along[std::size_t(band)] * y[i] / (pole * pole);
    }
    return part;
}

/// Scales down the asymmetric part until irradiance is ≥ 0 at all normals of the rings.
void keep_positive(std::span<glm::vec3> coefficients, const glm::vec3& axis)
{
    const auto axial = axial_part(coefficients, axis);
    const auto even = std::span(axial).first(coefficients.size());
    glm::vec3 keep(1.0f);
    for (const glm::vec3& normal : rings_about(axis)) {
        const glm::vec3 mean = irradiance_at(even, normal);
        const glm::vec3 all = irradiance_at(coefficients, normal);
        for (int c = 0; c < 3; ++c)
            if (all[c] < 0.0f)
                keep[c] = std::min(keep[c], std::max(mean[c], 0.0f) / (mean[c] - all[c]));
    }
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        coefficients[i] = axial[i] + keep * (coefficients[i] - axial[i]);
}

}  // namespace

void settle(const DirectionalFit& fit, std::span<glm::vec3> coefficients, const glm::vec3& normal,
            const glm::vec3& irradiance)
{
    const glm::vec3 summed = irradiance_at(coefficients, normal);
    glm::vec3 scale(1.0f);
    for (int c = 0; c < 3; ++c) {
        if (irradiance[c] <= 0.0f)
            scale[c] = 0.0f;
        else if (summed[c] > 0.0f)
            scale[c] = std::clamp(irradiance[c] / summed[c], 1.0f / kMaxScale, kMaxScale);
    }
    for (glm::vec3& coefficient : coefficients)
        coefficient *= scale;
    fit.match(coefficients, normal, irradiance);
    keep_positive(coefficients, normal);
}

}  // namespace lumel
