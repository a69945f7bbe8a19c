// Shadow rays and the estimate they make of one source, against closed forms.

#include <gtest/gtest.h>

#include "../support/closed_forms.h"
#include "lights/shadow_rays.h"
#include "lights/source_estimate.h"
#include "lit_point.h"
#include "rays/cast/ray_caster.h"
#include "rays/cast/ray_scene.h"

namespace lumel {
namespace {

constexpr float kHeight = 1.0f, kEmission = 3.0f;

/// What side² shadow rays find of a plate of 1 m × 1 m above the point, behind a screen half as
/// high that covers all directions x / z from `low` to `high`.
SourceEstimate estimate(float low, float high, int side)
{
    Scene scene;
    support::add_quad(
        scene, support::plate_above({-0.5f, -0.5f}, {0.5f, 0.5f}, kHeight, glm::vec3(kEmission)));
    const float screen = 0.5f * kHeight;
    support::add_quad(scene, support::plate_above({low * screen, -1.0f}, {high * screen, 1.0f},
                                                  screen, glm::vec3(0.0f)));
    const Surfaces surfaces(scene);
    const LightSources sources(scene, surfaces, 2.0f);
    const RayScene rays(scene);
    const RayOrigin start = support::upward();
    ShadowRays shadows;
    support::for_square(side, [&](const glm::vec2& at) {
        const SourceSample sample = sources.sample(0, start, at);
        shadows.add(sample, ray_towards(sample, start, shadows.size()));
    });
    shadows.cast(*cast_on_host(rays));
    SourceEstimate found;
    for (std::uint32_t k = 0; k < shadows.size(); ++k)
        found.add(shadows.sample(k), shadows.transmittance(k));
    return found;
}

double light_of(const Span& x)
{
    return double(kEmission) * point_to_parallel_rectangle(x, {-0.5, 0.5}, double(kHeight));
}

TEST(ShadowRays, FindTheFormFactorOfThePartThatIsVisible)
{
    for (const float edge : {-0.3f, 0.0f, 0.2f}) {
        const SourceEstimate found = estimate(edge, 2.0f, 128);
        EXPECT_NEAR(double(found.light().g) / light_of({-0.5, double(edge)}), 1.0, 0.01) << edge;
        EXPECT_GT(found.hidden, 0u);
        EXPECT_GT(found.free, 0u);
    }
}

TEST(ShadowRays, HaveNoNoiseWhereASourceIsWhollyVisibleOrHidden)
{
    for (const int side : {1, 2, 5}) {
        EXPECT_NEAR(double(estimate(2.0f, 3.0f, side).light().g) / light_of({-0.5, 0.5}), 1.0, 1e-5)
            << side;
        EXPECT_EQ(estimate(-3.0f, 3.0f, side).light(), glm::vec3(0.0f)) << side;
    }
}

TEST(ShadowRays, AreNotCastWhereNothingIsSent)
{
    ShadowRays shadows;
    const RayOrigin start = support::upward();
    const SourceSample dark{.direction = {0.0f, 0.0f, 1.0f}, .distance = 1.0f};
    shadows.add(dark, ray_towards(dark, start, 0));
    Scene scene;
    support::add_quad(scene, support::plate_above({-1, -1}, {1, 1}, 2.0f, glm::vec3(0.0f)));
    const RayScene rays(scene);
    shadows.cast(*cast_on_host(rays));
    EXPECT_EQ(shadows.size(), 1u);
    EXPECT_EQ(shadows.transmittance(0), glm::vec3(0.0f));
}

}  // namespace
}  // namespace lumel
