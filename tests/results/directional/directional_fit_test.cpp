// The fit of directional light, by itself.

#include "results/directional/directional_fit.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace lumel {
namespace {

constexpr double kPi = std::numbers::pi;

double elevation(std::size_t row)
{
    return 2.0 * double(row) / double(kElevations - 1) - 1.0;
}

TEST(SphericalHarmonics, AreOrthonormal)
{
    constexpr int kRings = 200, kAround = 64;
    double product[kMaxCoefficients][kMaxCoefficients] = {};
    for (int i = 0; i < kRings; ++i)
        for (int k = 0; k < kAround; ++k) {
            const double z = (2.0 * i + 1.0) / kRings - 1.0, s = std::sqrt(1.0 - z * z);
            const double angle = 2.0 * kPi * (k + 0.5) / kAround;
            const auto y =
                harmonics({float(s * std::cos(angle)), float(s * std::sin(angle)), float(z)});
            for (std::size_t a = 0; a < y.size(); ++a)
                for (std::size_t b = 0; b < y.size(); ++b)
                    product[a][b] += double(y[a] * y[b]) * 4.0 * kPi / (kRings * kAround);
        }
    for (int a = 0; a < kMaxCoefficients; ++a)
        for (int b = 0; b < kMaxCoefficients; ++b)
            EXPECT_NEAR(product[a][b], a == b ? 1.0 : 0.0, 3e-4) << a << ' ' << b;
}

// Uniform radiance over the whole sphere: c_00 = √4π L, H = π L everywhere.
TEST(SphericalHarmonics, OfUniformRadianceGiveItsIrradiance)
{
    std::vector<glm::vec3> coefficients(9, glm::vec3(0.0f));
    coefficients[0] = glm::vec3(float(std::sqrt(4.0 * kPi)));
    EXPECT_NEAR(double(irradiance_at(coefficients, {0, 1, 0}).g), kPi, 1e-5);
}

TEST(DirectionalFit, GivesTheCosineBackAtTheNormalItself)
{
    for (int order = 1; order <= 2; ++order) {
        const DirectionalFit fit(order);
        ASSERT_EQ(fit.rows().size(), kElevations);
        for (std::size_t i = 0; i < kElevations; ++i) {
            const FitRow& row = fit.rows()[i];
            // Coefficients for the normal along z, where only those with m = 0 count.
            std::vector<glm::vec3> c(std::size_t(coefficient_count(order)), glm::vec3(0.0f));
            c[0] = glm::vec3(row.zero);
            c[2] = glm::vec3(row.along);
            if (order == 2)
                c[6] = glm::vec3(2.0f * kY20 * row.axial);  // 3 kY20 M_zz, M_zz = 2/3 axial
            EXPECT_NEAR(double(irradiance_at(c, {0, 0, 1}).g), std::max(elevation(i), 0.0), 1e-5);
        }
    }
}

// What the fit makes of radiance 1 from the whole half sphere is what projection makes of it.
TEST(DirectionalFit, OfAUniformHalfSphereIsItsProjection)
{
    for (int order = 1; order <= 2; ++order) {
        double zero = 0.0, along = 0.0, axial = 0.0;
        const DirectionalFit fit(order);
        for (std::size_t i = kElevations / 2; i < kElevations; ++i) {
            const bool end = i == kElevations / 2 || i + 1 == kElevations;  // trapezoids
            const double ring = 2.0 * kPi * 2.0 / (kElevations - 1) * (end ? 0.5 : 1.0);
            zero += ring * double(fit.rows()[i].zero);
            along += ring * double(fit.rows()[i].along);
            axial += ring * double(fit.rows()[i].axial);
        }
        EXPECT_NEAR(zero, std::sqrt(kPi), 0.002);
        EXPECT_NEAR(along, std::sqrt(0.75 * kPi), 0.002);
        EXPECT_NEAR(axial, 0.0, 0.005);
    }
}

TEST(DirectionalFit, SettledCoefficientsMatchAndPromiseNoLessThanNoLight)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> u(-1.0f, 1.0f);
    for (int order = 1; order <= 2; ++order) {
        const DirectionalFit fit(order);
        for (int k = 0; k < 100; ++k) {
            const glm::vec3 normal = glm::normalize(glm::vec3(u(random), u(random), u(random)));
            // Light that comes mostly from one side.
            std::vector<glm::vec3> c;
            for (int i = 0; i < coefficient_count(order); ++i)
                c.emplace_back(i == 0 ? 0.5f : 0.5f * u(random));
            const glm::vec3 irradiance(0.7f, 0.1f, 0.0f);
            settle(fit, c, normal, irradiance);
            const glm::vec3 back = irradiance_at(c, normal);
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(back[channel], irradiance[channel], 1e-5f);
            const glm::vec3 side =
                glm::normalize(glm::cross(normal, glm::vec3(u(random), u(random), u(random))));
            for (const float tilt : {15.0f, 30.0f, 45.0f, 60.0f}) {
                const float angle = glm::radians(tilt);
                const glm::vec3 h =
                    irradiance_at(c, std::cos(angle) * normal + std::sin(angle) * side);
                EXPECT_GE(h.r, -0.04f * irradiance.r) << "order " << order << " tilt " << tilt;
            }
        }
    }
}

}  // namespace
}  // namespace lumel
