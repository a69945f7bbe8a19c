#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "../../support/ktx2.h"
#include "base/images/image_files.h"

namespace lumel {
namespace {

// Greys and colours from 2^-14 to 2^15, all of a texel's channels within a factor of 4.
Image wide_range()
{
    Image image(30, 7, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] =
            std::ldexp(1.0f + float(i * 37 % 101) / 101.0f, int(i / 3 % 30) - 14 - int(i % 2));
    return image;
}

double largest_error(const Image& image, FloatTexel texel)
{
    const Image back = test::decode_ktx2(encode_ktx2(image, texel));
    EXPECT_EQ(back.width, image.width);
    EXPECT_EQ(back.height, image.height);
    double error = 0.0;
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        const auto texels = std::span(image.values).subspan(i, 3);
        const float largest = *std::max_element(texels.begin(), texels.end());
        for (std::size_t c = 0; c < 3; ++c)
            error = std::max(error, double(std::abs(back.values[i + c] - texels[c]) / largest));
    }
    return error;
}

TEST(Ktx2File, HalvesAreOffByAtMostHalfTheirLastDigit)
{
    EXPECT_LE(largest_error(wide_range(), FloatTexel::half), std::ldexp(1.0, -11));
}

TEST(Ktx2File, SharedExponentsAreOffByAtMostHalfTheLastDigitOfTheLargestChannel)
{
    EXPECT_LE(largest_error(wide_range(), FloatTexel::shared_exponent), std::ldexp(1.0, -9));
}

TEST(Ktx2File, WhatIsTooBrightStaysAtTheLargestNumberAndWhatIsNoNumberIsBlack)
{
    Image image(1, 1, 3);
    image.values = {1e9f, -1.0f, std::nanf("")};
    for (const auto& [texel, largest] : {std::pair(FloatTexel::half, 65504.0f),
                                         std::pair(FloatTexel::shared_exponent, 65408.0f)}) {
        const Image back = test::decode_ktx2(encode_ktx2(image, texel));
        EXPECT_EQ(back.values[0], largest);
        EXPECT_EQ(back.values[1], 0.0f);
        EXPECT_EQ(back.values[2], 0.0f);
    }
}

TEST(Ktx2File, TheDescriptorIsWhereTheHeaderSaysAndHasTheSizeThatItStates)
{
    for (const FloatTexel texel : {FloatTexel::half, FloatTexel::shared_exponent}) {
        const std::vector<unsigned char> file = encode_ktx2(wide_range(), texel);
        const std::uint32_t offset = test::word_at(file, 48), size = test::word_at(file, 52);
        EXPECT_EQ(test::word_at(file, offset), size);
        EXPECT_EQ(test::word_at(file, offset + 8) >> 16, size - 4);
        EXPECT_EQ(test::word_at(file, offset + 12), 0x00010101u);  // RGB, Rec. 709, linear
        EXPECT_EQ(test::word_at(file, offset + 20), texel == FloatTexel::half ? 8u : 4u);
        EXPECT_EQ(offset + size, test::word_at(file, 80));
    }
}

}  // namespace
}  // namespace lumel
