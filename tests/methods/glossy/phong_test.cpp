// The reflectance model of the glossy solver.

#include "methods/glossy/phong.h"

#include <cmath>
#include <numbers>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "truth/brdf.h"

namespace lumel {
namespace {

constexpr float kExponents[] = {1.0f, 3.0f, 10.0f, 100.0f, 1000.0f};

glm::dvec3 direction(double cosine, double angle)
{
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

/// ∫ f_r cosθ' dω' by a fine grid over the hemisphere.
double reflected(double cos_in, float shininess)
{
    constexpr int kRings = 2000, kSectors = 2000;
    const glm::dvec3 mirror = direction(cos_in, 0.0);
    double sum = 0.0;
    for (int ring = 0; ring < kRings; ++ring) {
        const double cosine = (ring + 0.5) / kRings;
        for (int sector = 0; sector < kSectors; ++sector) {
            const double angle = 2.0 * std::numbers::pi * (sector + 0.5) / kSectors;
            const double along = glm::dot(mirror, direction(cosine, angle));
            sum +=
                cosine * double(phong_lobe(float(cos_in), float(cosine), float(along), shininess));
        }
    }
    return sum * 2.0 * std::numbers::pi / (double(kRings) * kSectors);
}

TEST(Phong, ReflectsNoMoreThanArrivesFromAnyDirection)
{
    for (const float shininess : kExponents)
        for (int i = 0; i <= 100; ++i) {
            const float albedo = phong_albedo(0.01f * float(i), shininess);
            EXPECT_LE(albedo, 1.0f) << "n " << shininess << ", cos " << 0.01 * i;
            EXPECT_GE(albedo, 0.0f);
        }
}

TEST(Phong, ItsAlbedoIsTheIntegralOfItsLobe)
{
    for (const float shininess : {1.0f, 10.0f, 100.0f})
        for (const double cos_in : {0.1, 0.5, 0.9})
            EXPECT_NEAR(phong_albedo(float(cos_in), shininess), reflected(cos_in, shininess), 0.005)
                << "n " << shininess << ", cos " << cos_in;
}

TEST(Phong, LooksTheSameBothWays)
{
    for (const float shininess : kExponents)
        EXPECT_EQ(phong_lobe(0.3f, 0.8f, 0.9f, shininess), phong_lobe(0.8f, 0.3f, 0.9f, shininess));
}

TEST(Phong, DirectionsAreDrawnAsOftenAsTheLobeIsDense)
{
    constexpr int kSide = 200, kSteps = 10'000;
    constexpr double kFrom = 0.5, kTo = 0.9;  // cosines with the mirror direction
    const glm::vec3 mirror = glm::normalize(glm::vec3(1.0f, -2.0f, 0.5f));
    for (const float shininess : kExponents) {
        double drawn = 0.0, dense = 0.0;
        for (int x = 0; x < kSide; ++x)
            for (int y = 0; y < kSide; ++y) {
                const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / float(kSide);
                const glm::vec3 direction = phong_direction(mirror, shininess, at);
                EXPECT_NEAR(glm::length(direction), 1.0f, 1e-5f);
                const auto cosine = double(glm::dot(direction, mirror));
                drawn += cosine > kFrom && cosine < kTo ? 1.0 / (kSide * kSide) : 0.0;
            }
        for (int i = 0; i < kSteps; ++i) {
            const double cosine = kFrom + (kTo - kFrom) * (i + 0.5) / kSteps;
            dense += 2.0 * std::numbers::pi * (kTo - kFrom) / kSteps *
                     double(phong_density(float(cosine), shininess));
        }
        EXPECT_NEAR(drawn, dense, 1.0 / kSide) << "n " << shininess;
    }
}

TEST(Phong, TheReferenceReflectsAlike)
{
    const glm::vec3 normal(0.0f, 0.0f, 1.0f);
    for (const float shininess : kExponents)
        for (const double cos_out : {0.1, 0.6, 1.0})
            for (const double cos_in : {0.05, 0.5, 0.95})
                for (const double angle : {0.0, 2.0, 3.0}) {
                    const glm::vec3 toward = direction(cos_out, 0.0);
                    const glm::vec3 incoming = direction(cos_in, angle);
                    const Brdf brdf({{}, glm::vec3(0.5f), shininess}, normal, toward);
                    const float mirrored =
                        glm::dot(glm::vec3(-toward.x, -toward.y, toward.z), incoming);
                    const float lobe =
                        phong_lobe(float(cos_in), float(cos_out), mirrored, shininess);
                    EXPECT_NEAR(brdf.respond(incoming).shape.x / std::numbers::pi_v<float>, lobe,
                                1e-3f * lobe);
                }
}

TEST(Phong, ItsTableHoldsItsAlbedo)
{
    const std::vector<float> table = phong_albedo_table();
    ASSERT_EQ(table.size(), std::size_t(kAlbedoExponents * (kAlbedoCosines + 1)));
    const int last_row = (kAlbedoExponents - 1) * (kAlbedoCosines + 1);
    EXPECT_NEAR(table[kAlbedoCosines - 1], phong_albedo(1.0f, 1.0f), 1e-6);
    EXPECT_NEAR(table[std::size_t(last_row + kAlbedoCosines - 1)], phong_albedo(1.0f, 1000.0f),
                1e-3);
    // Diffuse light on n = 1: between the albedos of its steepest and its flattest part.
    EXPECT_GT(table[kAlbedoCosines], table[0]);
    EXPECT_LT(table[kAlbedoCosines], 1.0f);
}

}  // namespace
}  // namespace lumel
