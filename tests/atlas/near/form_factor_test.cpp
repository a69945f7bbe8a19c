// Lambert's polygon form factor against closed forms.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "../../support/closed_forms.h"
#include "atlas/near/near_field.h"

namespace lumel {
namespace {

const glm::vec3 kOrigin(0.0f), kUp(0.0f, 0.0f, 1.0f);

float seen(const std::vector<glm::vec3>& corners, const glm::vec3& x = kOrigin,
           const glm::vec3& n = kUp)
{
    return polygon_form_factor(x, n, corners.data(), int(corners.size()));
}

/// A rectangle at height z, its front towards the ground.
std::vector<glm::vec3> ceiling(const Span& x, const Span& y, float z)
{
    const float x0 = float(x.low), x1 = float(x.high), y0 = float(y.low), y1 = float(y.high);
    return {{x0, y0, z}, {x0, y1, z}, {x1, y1, z}, {x1, y0, z}};
}

/// A wall in the plane y = distance, its front towards -y.
std::vector<glm::vec3> wall(const Span& x, const Span& z, float distance)
{
    const float x0 = float(x.low), x1 = float(x.high), z0 = float(z.low), z1 = float(z.high);
    return {{x0, distance, z0}, {x1, distance, z0}, {x1, distance, z1}, {x0, distance, z1}};
}

TEST(PolygonFormFactor, MatchesTheClosedFormOfAParallelRectangle)
{
    for (const float height : {0.01f, 0.5f, 1.0f, 30.0f}) {
        const Span x{-0.3, 1.2}, y{0.4, 0.9};
        const double exact = point_to_parallel_rectangle(x, y, height);
        EXPECT_NEAR(seen(ceiling(x, y, height)), exact, 1e-6 + 1e-5 * exact) << height;
    }
}

TEST(PolygonFormFactor, MatchesTheClosedFormOfAPerpendicularRectangleCutByTheHorizon)
{
    for (const Span& z : {Span{0.0, 1.0}, Span{-0.7, 0.6}, Span{0.2, 3.0}}) {
        const Span x{-0.5, 2.0};
        const double exact = point_to_perpendicular_rectangle(x, z, 0.8);
        EXPECT_NEAR(seen(wall(x, z, 0.8f)), exact, 1e-6) << z.low;
    }
}

TEST(PolygonFormFactor, OfATouchingWallTendsToOneHalf)
{
    const Span wide{-1000.0, 1000.0}, high{0.0, 1000.0};
    for (const float distance : {1e-2f, 1e-4f, 1e-6f})
        EXPECT_NEAR(seen(wall(wide, high, distance)), 0.5, 1e-3) << distance;
}

TEST(PolygonFormFactor, OfEverythingAboveIsOne)
{
    const Span wide{-1e4, 1e4};
    EXPECT_NEAR(seen(ceiling(wide, wide, 0.1f)), 1.0, 1e-4);
}

TEST(PolygonFormFactor, FromBehindIsZeroAndItsSignedValueThatOfTheFrontNegated)
{
    std::vector<glm::vec3> back = ceiling({-0.3, 1.2}, {0.4, 0.9}, 0.5f);
    const float front = seen(back);
    std::reverse(back.begin(), back.end());
    EXPECT_EQ(seen(back), 0.0f);
    EXPECT_NEAR(signed_form_factor(kOrigin, kUp, back.data(), int(back.size())), -front, 1e-6f);
}

TEST(PolygonFormFactor, IsTheSameForTheWholeAndForItsParts)
{
    const float whole = seen(wall({-1.0, 1.0}, {-1.0, 2.0}, 0.3f));
    const float parts = seen(wall({-1.0, 0.2}, {-1.0, 2.0}, 0.3f)) +
                        seen(wall({0.2, 1.0}, {-1.0, 0.5}, 0.3f)) +
                        seen(wall({0.2, 1.0}, {0.5, 2.0}, 0.3f));
    EXPECT_NEAR(whole, parts, 1e-6);
}

TEST(PolygonFormFactor, OfASmallDistantPolygonTendsToThePointFormula)
{
    const glm::vec3 centre(30.0f, 10.0f, 2.0f);  // 4 degrees above the horizon
    const float half = 0.05f;
    const glm::vec3 y(0, half, 0), z(0, 0, half);
    const std::vector<glm::vec3> corners = {centre + y - z, centre - y - z, centre - y + z,
                                            centre + y + z};
    const float r2 = glm::dot(centre, centre);
    const float exact = centre.z * centre.x / (r2 * r2 * float(M_PI)) * 4.0f * half * half;
    EXPECT_NEAR(seen(corners), exact, 1e-3 * exact);
}

TEST(PolygonFormFactor, IsZeroFromBehindAndBelowTheHorizon)
{
    std::vector<glm::vec3> turned = ceiling({-1.0, 1.0}, {-1.0, 1.0}, 1.0f);
    std::reverse(turned.begin(), turned.end());
    EXPECT_EQ(seen(turned), 0.0f);
    EXPECT_EQ(seen(wall({-1.0, 1.0}, {-2.0, -0.1}, 1.0f)), 0.0f);
    EXPECT_EQ(seen(wall({-1.0, 1.0}, {-2.0, 0.0}, 1.0f)), 0.0f);
}

TEST(PolygonFormFactor, OfAPolygonWithoutAreaIsZeroAndNeverNaN)
{
    const glm::vec3 p(0.3f, 0.2f, 1.0f);
    EXPECT_NEAR(seen({p, p, p, p}), 0.0f, 1e-7);
    EXPECT_NEAR(seen({p, 2.0f * p, 3.0f * p}), 0.0f, 1e-7);
    EXPECT_NEAR(seen({kOrigin, p, 2.0f * p}), 0.0f, 1e-7);
    EXPECT_FALSE(std::isnan(seen({{-1, 0, 0}, {1, 0, 0}, {1, 0, 1}, {-1, 0, 1}})));
}

}  // namespace
}  // namespace lumel
