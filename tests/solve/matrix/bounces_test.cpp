// Many bounces in one matrix.

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "solve/matrix/bounces.h"

namespace lumel {
namespace {

SquareMatrix two_by_two(float a, float b, float c, float d)
{
    return {2, {a, b, c, d}};
}

ColorMatrix gray(const SquareMatrix& matrix)
{
    return {{matrix, matrix, matrix}};
}

void expect_near(const SquareMatrix& found, const SquareMatrix& wanted)
{
    ASSERT_EQ(found.size, wanted.size);
    for (std::size_t i = 0; i < found.values.size(); ++i)
        EXPECT_NEAR(found.values[i], wanted.values[i], 1e-6f) << i;
}

TEST(ColorMatrix, IsTheFormFactorTimesTheSendersColor)
{
    const std::vector<glm::vec3> color = {{0.5f, 0.25f, 0.0f}, {1.0f, 0.5f, 0.1f}};
    const ColorMatrix matrix = color_matrix(two_by_two(0.0f, 0.4f, 0.8f, 0.2f), color);
    expect_near(matrix.channel[0], two_by_two(0.0f, 0.4f, 0.4f, 0.2f));
    expect_near(matrix.channel[1], two_by_two(0.0f, 0.2f, 0.2f, 0.1f));
    expect_near(matrix.channel[2], two_by_two(0.0f, 0.04f, 0.0f, 0.02f));
}

// X = (0 a; b 0): X² = ab I, X³ = ab X.
TEST(Bounces, AreTheSumOfPowers)
{
    const float a = 0.5f, b = 0.25f;
    const ColorMatrix once = gray(two_by_two(0.0f, a, b, 0.0f));
    const float two = a * b, four = two * two;
    expect_near(bounces(once, 0).channel[0], two_by_two(0.0f, 0.0f, 0.0f, 0.0f));
    expect_near(bounces(once, 1).channel[0], once.channel[0]);
    expect_near(bounces(once, 2).channel[1], two_by_two(two, a, b, two));
    expect_near(bounces(once, 3).channel[2], two_by_two(two, a + two * a, b + two * b, two));
    expect_near(bounces(once, 6).channel[0],
                two_by_two(two + four + four * two, a * (1.0f + two + four),
                           b * (1.0f + two + four), two + four + four * two));
    const float all = 1.0f / (1.0f - two);
    expect_near(bounces(once, kAllBounces).channel[0],
                two_by_two(all - 1.0f, a * all, b * all, all - 1.0f));
}

// Any F whose rows add to 1, any albedo ρ for all: the rows of all bounces add to ρ / (1 − ρ).
TEST(Bounces, OfAFurnaceAddToAlbedoOverOneMinusAlbedo)
{
    constexpr std::uint32_t n = 50;
    SquareMatrix factors{n, std::vector<float>(n * n)};
    for (std::uint32_t i = 0; i < n; ++i) {
        float sum = 0.0f;
        for (std::uint32_t j = 0; j < n; ++j)
            sum += factors.values[i * n + j] = i == j ? 0.0f : float(1 + (i * 7 + j * 13) % 11);
        for (std::uint32_t j = 0; j < n; ++j)
            factors.values[i * n + j] /= sum;
    }
    const glm::vec3 albedo(0.2f, 0.5f, 0.9f);
    const ColorMatrix all =
        bounces(color_matrix(factors, std::vector<glm::vec3>(n, albedo)), kAllBounces);
    for (const glm::vec3& light : multiply(all, std::vector<glm::vec3>(n, glm::vec3(1.0f))))
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(light[c], albedo[c] / (1.0f - albedo[c]), 1e-5f * 9.0f);
}

TEST(Bounces, OfLightThatDoesNotFadeAreRefused)
{
    EXPECT_THROW(bounces(gray(two_by_two(0.0f, 1.0f, 1.0f, 0.0f)), kAllBounces), Error);
    EXPECT_THROW(bounces(gray(two_by_two(0.0f, 2.0f, 1.0f, 0.0f)), kAllBounces), Error);
    EXPECT_THROW(bounces(gray(two_by_two(0.0f, -0.1f, 0.1f, 0.0f)), kAllBounces), Error);
    EXPECT_THROW(bounces(gray(two_by_two(0.0f, NAN, 0.1f, 0.0f)), 2), Error);
    EXPECT_THROW(bounces(gray(two_by_two(0.0f, 1e30f, 1e30f, 0.0f)), 8), Error);
}

TEST(Multiply, IsEachChannelByItself)
{
    const ColorMatrix matrix{
        {two_by_two(1, 2, 3, 4), two_by_two(0, 1, 0, 0), two_by_two(0, 0, 0, 2)}};
    const std::vector<glm::vec3> x = {{1.0f, 10.0f, 100.0f}, {2.0f, 20.0f, 200.0f}};
    const std::vector<glm::vec3> y = multiply(matrix, x);
    EXPECT_EQ(y[0], glm::vec3(5.0f, 20.0f, 0.0f));
    EXPECT_EQ(y[1], glm::vec3(11.0f, 0.0f, 400.0f));
}

}  // namespace
}  // namespace lumel
