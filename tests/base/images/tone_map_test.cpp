#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/images/image_files.h"
#include "base/images/tone_curve.shared.h"

namespace lumel {
namespace {

constexpr int kSide = 40;

Image uniform(float value, const glm::vec3& color = glm::vec3(1.0f))
{
    Image image(kSide, kSide, 4);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            for (int c = 0; c < 4; ++c)
                image.at(x, y)[c] = c < 3 ? value * color[c] : 1.0f;
    return image;
}

/// Fills the top rows.
Image with_rows(Image image, int rows, float value)
{
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < kSide; ++x)
            std::fill_n(image.at(x, y), 3, value);
    return image;
}

/// From 0.01 to 1, evenly in its logarithm.
Image ramp(float factor = 1.0f)
{
    Image image = uniform(1.0f);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            std::fill_n(image.at(x, y), 3,
                        factor * std::pow(0.01f, float(y * kSide + x) / float(kSide * kSide - 1)));
    return image;
}

int code(float value)
{
    return int(std::lround(255.0f * value));
}

float stops(float exposure, float before)
{
    return std::log2(exposure / before);
}

TEST(Exposure, MakesTheLogAverageMidGreyAtAnyScale)
{
    for (const float scale : {1e-6f, 0.3f, 1.0f, 5e4f}) {
        EXPECT_EQ(code(tone_map(uniform(scale)).at(3, 3)[0]), 128);
        // The mean of log2 of the ramp is that of 0.1.
        const float exposed = 0.1f * scale * choose_exposure(ramp(scale)).value();
        EXPECT_NEAR(code(tone_curve(glm::vec3(exposed)).g), 128, 1);
    }
}

TEST(Exposure, TwiceTheLightChangesNoPixel)
{
    const Image once = tone_map(ramp()), twice = tone_map(ramp(2.0f));
    for (std::size_t i = 0; i < once.values.size(); ++i)
        ASSERT_EQ(code(once.values[i]), code(twice.values[i]));
}

TEST(Exposure, ALampInViewDoesNotDarkenTheRoom)
{
    const float without = choose_exposure(ramp()).value();
    EXPECT_GT(stops(choose_exposure(with_rows(ramp(), 1, 1e4f)).value(), without), -0.2f);
    EXPECT_LT(stops(choose_exposure(with_rows(ramp(), 1, 1e4f)).value(), without), 0.2f);
}

TEST(Exposure, BlackAndNearlyBlackPixelsDoNotBrightenTheRest)
{
    for (const float black : {0.0f, 1e-12f})
        EXPECT_EQ(choose_exposure(with_rows(uniform(1.0f), kSide / 2, black)),
                  choose_exposure(uniform(1.0f)));
}

TEST(Exposure, IsAtMostAStopHigherWhereMostIsBright)
{
    const float exposed = choose_exposure(with_rows(uniform(1.0f), 4, 0.02f)).value();
    const float log_average = std::pow(0.02f, 0.1f);
    EXPECT_NEAR(stops(exposed, 0.18f / log_average), 1.0f, 1e-3f);
}

TEST(Exposure, KeepsSunAndShade)
{
    // A third in the sun, which is 60 times as bright as the shade.
    const Image shown = tone_map(with_rows(uniform(1.0f), kSide / 3, 60.0f));
    EXPECT_LT(code(shown.at(0, 0)[0]), 250);
    EXPECT_GT(code(shown.at(0, kSide - 1)[0]), 50);
}

TEST(Exposure, UncoveredTexelsDoNotCount)
{
    Image image = with_rows(uniform(1.0f), 10, 1000.0f);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < kSide; ++x)
            image.at(x, y)[3] = 0.0f;
    EXPECT_EQ(choose_exposure(image), choose_exposure(uniform(1.0f)));
}

TEST(ToneMap, ABlackMapStaysBlack)
{
    EXPECT_FALSE(choose_exposure(uniform(0.0f)));
    EXPECT_EQ(tone_map(uniform(0.0f)).at(2, 2)[0], 0.0f);
}

TEST(ToneMap, KeepsAlpha)
{
    Image image = uniform(0.5f);
    image.at(1, 1)[3] = 0.25f;
    EXPECT_EQ(tone_map(image).at(1, 1)[3], 0.25f);
}

TEST(ToneCurve, RisesSteadilyToWhite)
{
    float last = -1.0f;
    for (float stop = -14.0f; stop < 6.0f; stop += 0.01f) {
        const float now = tone_curve(glm::vec3(std::exp2(stop))).g;
        EXPECT_GE(now, last - 1e-6f) << stop;
        EXPECT_LE(now, 1.0f);
        last = now;
    }
    EXPECT_EQ(code(tone_curve(glm::vec3(16.0f)).g), 255);
    EXPECT_EQ(code(tone_curve(glm::vec3(1e6f)).g), 255);
}

TEST(ToneCurve, GreyStaysGrey)
{
    for (float value = 1e-4f; value < 20.0f; value *= 1.5f) {
        const glm::vec3 codes = tone_curve(glm::vec3(value));
        EXPECT_NEAR(codes.r, codes.g, 1e-3f);
        EXPECT_NEAR(codes.b, codes.g, 1e-3f);
    }
}

TEST(ToneCurve, IsAgX)
{
    // By the formulas in double precision, with exact powers.
    const auto near = [](const glm::vec3& exposed, const glm::ivec3& codes) {
        const glm::vec3 found = 255.0f * tone_curve(exposed);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], float(codes[c]), 0.7f) << exposed.r;
    };
    near({1.0f, 0.0f, 0.0f}, {221, 92, 73});
    near({0.3f, 0.02f, 0.02f}, {158, 57, 51});
    near({0.063f, 0.0065f, 0.005f}, {78, 11, 8});
    near({0.56f, 1.8f, 0.364f}, {192, 219, 174});
    near({4.0f, 4.0f, 4.0f}, {239, 239, 239});
}

/// Hue in degrees, of display codes.
double hue(const glm::vec3& c)
{
    return std::atan2(std::sqrt(3.0) * double(c.g - c.b), double(2.0f * c.r - c.g - c.b)) * 180.0 /
           3.14159265358979;
}

TEST(ToneCurve, SaturatedWallsNeitherClipNorTurnTheirHue)
{
    // Red and green of the Cornell box.
    for (const glm::vec3& wall :
         {glm::vec3(0.63f, 0.065f, 0.05f), glm::vec3(0.14f, 0.45f, 0.091f)}) {
        const double dim = hue(tone_curve(0.2f * wall));
        for (const float light : {0.5f, 1.0f, 2.0f, 4.0f}) {
            const glm::vec3 codes = tone_curve(light * wall);
            EXPECT_LT(code(std::max({codes.r, codes.g, codes.b})), 253) << light;
            EXPECT_NEAR(hue(codes), dim, 10.0) << light;
        }
    }
}

TEST(ToneCurve, TheSrgbCurveIsTheStandardsOwn)
{
    const glm::vec3 codes = srgb_from_linear({0.214041f, 0.0031308f, 1.0f});
    EXPECT_NEAR(codes.r, 0.5f, 8e-5f);
    EXPECT_NEAR(codes.g, 0.04045f, 1e-6f);
    EXPECT_NEAR(codes.b, 1.0f, 8e-5f);
}

}  // namespace
}  // namespace lumel
