#include <gtest/gtest.h>

#include "base/images/image_files.h"

namespace lumel {
namespace {

Image uniform(int side, float value)
{
    Image image(side, side, 4);
    image.values.assign(image.values.size(), value);
    for (std::size_t i = 3; i < image.values.size(); i += 4)
        image.values[i] = 1.0f;
    return image;
}

TEST(ToneMap, DoesNotDependOnTheUnitOfTheMap)
{
    Image image = uniform(8, 1.0f);
    for (std::size_t i = 0; i < image.values.size(); i += 4)
        image.values[i] = 0.01f * float(i);
    Image thousandfold = image;
    for (std::size_t i = 0; i < image.values.size(); ++i)
        if (i % 4 != 3)
            thousandfold.values[i] *= 1000.0f;
    const Image a = tone_map(image), b = tone_map(thousandfold);
    for (std::size_t i = 0; i < a.values.size(); ++i)
        EXPECT_NEAR(a.values[i], b.values[i], 1e-4f);
}

TEST(ToneMap, LampsDoNotDarkenTheRoom)
{
    const float without = choose_exposure(uniform(20, 1.0f));
    Image room = uniform(20, 1.0f);
    for (int x = 0; x < 20; ++x)  // a tenth of the map is a lamp
        for (int y = 0; y < 2; ++y)
            for (int c = 0; c < 3; ++c)
                room.at(x, y)[c] = 5000.0f;
    EXPECT_GT(choose_exposure(room), 0.1f * without);
}

TEST(ToneMap, UncoveredTexelsDoNotCount)
{
    Image image = uniform(10, 1.0f);
    for (int x = 0; x < 10; ++x) {
        image.at(x, 0)[0] = image.at(x, 0)[1] = 1000.0f;
        image.at(x, 0)[3] = 0.0f;
    }
    EXPECT_FLOAT_EQ(choose_exposure(image), choose_exposure(uniform(10, 1.0f)));
}

TEST(ToneMap, RisesSteadilyBelowWhiteAndKeepsAlpha)
{
    float last = -1.0f;
    for (float x = 0.0f; x < 8.0f; x += 0.01f) {
        const float code = display_from_linear(x);
        EXPECT_GE(code, last);
        EXPECT_LE(code, 1.0f);
        last = code;
    }
    Image image = uniform(2, 0.5f);
    image.at(1, 1)[3] = 0.25f;
    EXPECT_EQ(tone_map(image).at(1, 1)[3], 0.25f);
}

TEST(ToneMap, ABlackMapStaysBlack)
{
    const Image display = tone_map(uniform(4, 0.0f));
    EXPECT_EQ(display.at(2, 2)[0], 0.0f);
}

TEST(ToneMap, TheSrgbCurveIsTheStandardsOwn)
{
    EXPECT_NEAR(srgb_from_linear(0.214041f), 0.5f, 1e-5f);
    EXPECT_NEAR(srgb_from_linear(0.0031308f), 0.04045f, 1e-6f);
    EXPECT_NEAR(srgb_from_linear(1.0f), 1.0f, 1e-6f);
}

}  // namespace
}  // namespace lumel
