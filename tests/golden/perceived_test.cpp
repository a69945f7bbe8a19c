// The measure by which previews are compared knows what an eye does.

#include "perceived.h"

namespace lumel::test {
namespace {

constexpr int kSide = 64;

/// A grey ramp with a darker square.
Picture ramp(int square_at = 20, int brighter = 0, int noise = 0)
{
    Picture picture{kSide, kSide, {}};
    unsigned random = 1;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const bool inside = x >= square_at && x < square_at + 16 && y >= 20 && y < 36;
            random = random * 1664525u + 1013904223u;
            const int off = noise > 0 ? int(random >> 16) % (2 * noise + 1) - noise : 0;
            picture.rgb.insert(
                picture.rgb.end(), 3,
                static_cast<unsigned char>((inside ? 60 : 100 + x) + brighter + off));
        }
    return picture;
}

Perceived apart(const Picture& a, const Picture& b)
{
    return summary_of(perceived_difference(a, b));
}

TEST(PerceivedDifference, OfAPictureToItselfIsNone)
{
    const Perceived none = apart(ramp(), ramp());
    EXPECT_EQ(none.mean, 0.0);
    EXPECT_EQ(none.high, 0.0);
}

TEST(PerceivedDifference, OfBlackToWhiteIsAHundred)
{
    const Picture black{2, 1, {0, 0, 0, 0, 0, 0}}, white{2, 1, {255, 255, 255, 255, 255, 255}};
    EXPECT_NEAR(apart(black, white).mean, 100.0, 0.1);
}

TEST(PerceivedDifference, OfNoiseOfOneCodeIsLess)
{
    // Than of a picture that is brighter by one code everywhere.
    EXPECT_LT(apart(ramp(), ramp(20, 0, 1)).mean, 0.5 * apart(ramp(), ramp(20, 1)).mean);
}

TEST(PerceivedDifference, OfAShadowTwoPixelsAsideIsLarge)
{
    EXPECT_GT(apart(ramp(), ramp(22)).high, 10.0);
    EXPECT_LT(apart(ramp(), ramp(22)).mean, 1.5);
}

}  // namespace
}  // namespace lumel::test
