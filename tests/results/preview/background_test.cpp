// The sky behind pictures.

#include <gtest/gtest.h>

#include "base/images/image_files.h"
#include "results/preview/background.h"

namespace lumel {
namespace {

constexpr int kSide = 9;  // [pixels]; the middle one looks along -z
constexpr float kUpper = 300.0f, kExposure = 1e-3f;

/// Bright above the horizon, black below.
Sky half_sky()
{
    return {.width = 1, .height = 2, .radiance = {glm::vec3(kUpper), glm::vec3(0.0f)}};
}

/// Display code of this radiance.
float code_of(float radiance)
{
    Image one(1, 1, 4);
    for (int c = 0; c < 3; ++c)
        one.at(0, 0)[c] = radiance;
    return tone_map(one, kExposure).at(0, 0)[1];
}

TEST(SkyBehind, IsSeenInItsDirectionWhereNoSurfaceIs)
{
    Image picture(kSide, kSide, 4);
    put_sky_behind(picture, half_sky(), View{.aspect = 1.0f}, kExposure);
    ASSERT_GT(code_of(kUpper), code_of(0.0f));
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            EXPECT_EQ(picture.at(x, y)[3], 1.0f);
            if (y == kSide / 2)  // the horizon
                continue;
            EXPECT_EQ(picture.at(x, y)[1], code_of(y < kSide / 2 ? kUpper : 0.0f)) << x << y;
        }
}

TEST(SkyBehind, IsMixedByTheShareOfAPixelThatSurfacesLeave)
{
    constexpr float kSurface = 0.25f;
    for (const float covered : {0.25f, 0.75f, 1.0f}) {
        Image picture(1, 1, 4);
        for (int c = 0; c < 3; ++c)
            picture.at(0, 0)[c] = kSurface;
        picture.at(0, 0)[3] = covered;
        const glm::mat4 up({1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1});
        put_sky_behind(picture, half_sky(), View{.transform = up, .aspect = 1.0f}, kExposure);
        EXPECT_FLOAT_EQ(picture.at(0, 0)[1],
                        covered * kSurface + (1.0f - covered) * code_of(kUpper));
        EXPECT_EQ(picture.at(0, 0)[3], 1.0f);
    }
}

TEST(SkyBehind, LeavesAPictureWithoutSkyTransparent)
{
    Image picture(2, 2, 4);
    put_sky_behind(picture, {}, View{}, kExposure);
    EXPECT_EQ(picture.values, Image(2, 2, 4).values);
}

}  // namespace
}  // namespace lumel
