// A camera that walks, turns and orbits comes back, and shows what geometry says.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "viewer/session/camera.h"

namespace lumel {
namespace {

constexpr float kPi = std::numbers::pi_v<float>, kClose = 1e-5f;

/// At (1, 2, 3), looking along -z, 90 degrees of view in a picture twice as wide as it is high.
ViewCamera camera()
{
    View view;
    view.transform[3] = glm::vec4(1.0f, 2.0f, 3.0f, 1.0f);
    view.vertical_fov = kPi / 2.0f;
    view.aspect = 2.0f;
    return ViewCamera(view);
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float close = kClose)
{
    EXPECT_LT(glm::distance(a, b), close)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

void expect_alike(const ViewCamera& a, const ViewCamera& b, float close = kClose)
{
    expect_near(a.eye(), b.eye(), close);
    expect_near(a.forward(), b.forward(), close);
    expect_near(a.up(), b.up(), close);
}

TEST(ViewCamera, WalksLevelToWhereItLooksAndBack)
{
    ViewCamera walked = camera();
    walked.gaze(kPi / 2.0f, 0.7f);  // to -x, and up
    const ViewCamera before = walked;
    walked.walk({2.0f, 0.5f, 0.25f});
    // To its right is -z.
    expect_near(walked.eye(), glm::vec3(1.0f - 2.0f, 2.0f + 0.25f, 3.0f - 0.5f));
    expect_near(walked.forward(), before.forward());
    walked.walk({-2.0f, -0.5f, -0.25f});
    expect_alike(walked, before);
}

TEST(ViewCamera, TurnsAroundInFourSteps)
{
    ViewCamera turned = camera();
    const glm::vec3 ways[] = {{-1, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, -1}};
    for (const glm::vec3& way : ways) {
        turned.gaze(kPi / 2.0f, 0.0f);
        expect_near(turned.forward(), way);
        expect_near(turned.up(), {0, 1, 0});
    }
    expect_alike(turned, camera());
}

TEST(ViewCamera, LooksNoFartherThanStraightUpAndStaysUpright)
{
    ViewCamera turned = camera();
    for (int k = 0; k < 10; ++k)
        turned.gaze(0.0f, 1.0f);
    EXPECT_GT(turned.forward().y, 0.99f);
    EXPECT_LT(turned.forward().z, 0.0f);
    turned.gaze(0.0f, -kPi / 2.0f);
    EXPECT_NEAR(turned.forward().y, 0.0f, 0.01f);
    EXPECT_GT(turned.up().y, 0.99f);
}

TEST(ViewCamera, ShowsWhatItLooksAtInTheMiddleAndUpright)
{
    ViewCamera looking = camera();
    const glm::vec3 target(-2.0f, 0.5f, 7.0f);
    looking.look_at(target);
    expect_near(looking.forward(), glm::normalize(target - looking.eye()));
    const auto place = place_in_picture(looking.view(), target);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->x, 0.5f, kClose);
    EXPECT_NEAR(place->y, 0.5f, kClose);
    EXPECT_NEAR(glm::cross(looking.forward(), looking.up()).y, 0.0f, kClose);
    EXPECT_GT(looking.up().y, 0.0f);
    EXPECT_THROW(looking.look_at(looking.eye()), Error);
}

TEST(ViewCamera, OrbitsWithItsPivotWhereItIsInThePictureAndComesBack)
{
    ViewCamera orbiting = camera();
    orbiting.gaze(0.2f, -0.3f);
    const ViewCamera before = orbiting;
    const glm::vec3 pivot(0.3f, 1.0f, -1.0f);
    const auto place = place_in_picture(before.view(), pivot);
    ASSERT_TRUE(place);
    constexpr int kSteps = 12;
    for (int k = 0; k < kSteps; ++k) {
        orbiting.orbit(pivot, 2.0f * kPi / kSteps, 0.0f);
        const auto now = place_in_picture(orbiting.view(), pivot);
        ASSERT_TRUE(now);
        EXPECT_NEAR(now->x, place->x, 1e-4f);
        EXPECT_NEAR(now->y, place->y, 1e-4f);
        EXPECT_NEAR(glm::distance(orbiting.eye(), pivot), glm::distance(before.eye(), pivot),
                    1e-4f);
        EXPECT_NEAR(orbiting.eye().y, before.eye().y, 1e-4f);
    }
    expect_alike(orbiting, before, 1e-4f);
    orbiting.orbit(pivot, 0.0f, 0.4f);
    EXPECT_GT(orbiting.eye().y, before.eye().y);
}

TEST(ViewCamera, PutsPointsWhereLinesThroughTheEyeCutThePicture)
{
    const View view = camera().view();
    // 4 m ahead the picture is 8 m high and 16 m wide.
    const auto at = [&](float right, float up, float ahead) {
        return place_in_picture(view, glm::vec3(1.0f + right, 2.0f + up, 3.0f - ahead));
    };
    for (const auto& [point, place] : {std::pair(at(0, 0, 4), glm::vec2(0.5f, 0.5f)),
                                       {at(8, 4, 4), {1.0f, 0.0f}},
                                       {at(-8, -4, 4), {0.0f, 1.0f}},
                                       {at(4, -2, 4), {0.75f, 0.75f}},
                                       {at(4, -2, 8), {0.625f, 0.625f}}}) {
        ASSERT_TRUE(point);
        EXPECT_NEAR(point->x, place.x, kClose);
        EXPECT_NEAR(point->y, place.y, kClose);
        // The ray through that place of the picture leads there.
        const Ray ray = ray_through(view, place);
        const auto back = place_in_picture(view, ray.origin + 3.0f * ray.direction);
        ASSERT_TRUE(back);
        EXPECT_NEAR(back->x, place.x, kClose);
        EXPECT_NEAR(back->y, place.y, kClose);
    }
    EXPECT_FALSE(at(0, 0, -1));
}

}  // namespace
}  // namespace lumel
