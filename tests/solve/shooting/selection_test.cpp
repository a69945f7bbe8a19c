// Shooters are chosen in proportion to their power ([BSS05] section 4.1).

#include "solve/shooting/power_pyramid.h"

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "tests/solve/shooting/draw.comp.h"

namespace lumel {
namespace {

TEST(Selection, IsInProportionToPower)
{
    // Powers over six orders of magnitude, and a tenth of the lumels dark.
    constexpr std::size_t kLumels = 3000;
    constexpr std::uint32_t kDraws = 1'000'000;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform;
    std::vector<glm::vec3> radiosity;
    std::vector<glm::vec4> surface;
    std::vector<double> power;
    double total = 0.0;
    for (std::size_t j = 0; j < kLumels; ++j) {
        const float level = j % 10 == 3 ? 0.0f : std::pow(10.0f, 6.0f * uniform(random) - 4.0f);
        radiosity.emplace_back(level);
        surface.emplace_back(0.5f, 0.5f, 0.5f, 0.1f + uniform(random));
        power.push_back(double(level) * double(surface.back().w));
        total += power.back();
    }

    const gpu::Device device;
    PowerPyramid pyramid(device, kLumels);
    const gpu::Kernel<shaders::Draw> draw(device);
    const gpu::Array<glm::vec3> source(device, std::span<const glm::vec3>(radiosity));
    const gpu::Array<glm::vec4> surfaces(device, std::span<const glm::vec4>(surface));
    const gpu::Array<std::uint32_t> drawn(device, kDraws);
    const gpu::Array<float> chance(device, kDraws);
    gpu::Commands commands(device);
    pyramid.build(commands, source, surfaces, 0.0f, 0.0f);
    commands.dispatch(draw, {.weights = pyramid.array(), .lumels = drawn, .chance = chance},
                      {pyramid.layout(), kDraws}, kDraws);
    commands.run();
    EXPECT_EQ(device.validation_messages(), "");

    std::vector<double> hits(kLumels);
    const std::vector<std::uint32_t> lumels = drawn.download();
    const std::vector<float> chances = chance.download();
    for (std::size_t i = 0; i < kDraws; ++i) {
        ++hits[lumels[i]];
        const double expected = power[lumels[i]] / total;
        EXPECT_NEAR(double(chances[i]), expected, 1e-4 * expected);
    }

    // Pearson's χ² over lumels expected at least ten times, the others as one.
    double chi2 = 0.0, rest_hits = 0.0, rest_expected = 0.0;
    int classes = 0;
    for (std::size_t j = 0; j < kLumels; ++j) {
        const double expected = kDraws * power[j] / total;
        if (power[j] == 0.0) {
            EXPECT_EQ(hits[j], 0.0);
        }
        if (expected < 10.0) {
            rest_hits += hits[j];
            rest_expected += expected;
            continue;
        }
        chi2 += (hits[j] - expected) * (hits[j] - expected) / expected;
        ++classes;
    }
    chi2 += (rest_hits - rest_expected) * (rest_hits - rest_expected) / rest_expected;
    // χ² of k degrees of freedom is k ± √2k; four of these are passed by once in 30,000 times.
    ASSERT_GT(classes, 500);
    EXPECT_LT(std::abs(chi2 - classes), 4.0 * std::sqrt(2.0 * classes));
}

}  // namespace
}  // namespace lumel
