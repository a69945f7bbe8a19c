// Rays shared out between sources find the light of all of them.

#include <random>

#include <gtest/gtest.h>

#include "../support/lamps.h"
#include "lights/ray_allocation.h"
#include "lit_point.h"

namespace lumel {
namespace {

using support::upward;

constexpr std::uint32_t kRays = 64;
constexpr int kMarks = 1 << 14;
const Receiver kPoint = receiver_at(glm::vec3(0.0f), {0.0f, 0.0f, 1.0f});

/// Two strong lamps among weak ones, all above a point.
struct ManyLamps {
    explicit ManyLamps(int weak)
        : scene(lamps(weak)),
          surfaces(scene),
          sources(scene, surfaces, 2.0f)
    {
    }
    static Scene lamps(int weak)
    {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> aside(-1.0f, 1.0f), above(0.5f, 2.0f),
            strength(0.1f, 1.0f);
        Scene scene;
        for (int k = 0; k < weak + 2; ++k) {
            const float intensity = (k % (weak / 2 + 1) == 1 ? 100.0f : 1.0f) * strength(random);
            const glm::vec3 place(aside(random), aside(random), above(random));
            scene.lights.push_back(
                support::make_lamp(PunctualLight::Kind::point, intensity, place));
        }
        return scene;
    }
    double light_of(std::size_t source) const
    {
        return double(sources.sample(source, upward(), glm::vec2(0.5f)).irradiance.g);
    }
    double light_of_all() const
    {
        double sum = 0.0;
        for (std::size_t s = 0; s < sources.count(); ++s)
            sum += light_of(s);
        return sum;
    }

    Scene scene;
    Surfaces surfaces;
    LightSources sources;
};

TEST(RayAllocation, FindsTheLightOfAllSourcesOnAverage)
{
    const ManyLamps many(200);
    const RayAllocation shares = allocate_rays(many.sources, kPoint, kRays);
    ASSERT_FALSE(shares.own.empty());
    ASSERT_GT(shares.rest_rays, 0u);
    double found = 0.0;
    for (const RayAllocation::Own& own : shares.own)
        found += many.light_of(own.source);
    for (int k = 0; k < kMarks; ++k) {
        const auto [source, chance] = shares.choose((float(k) + 0.5f) / kMarks);
        ASSERT_GT(chance, 0.0f);
        found += many.light_of(source) / double(chance) / kMarks;
    }
    EXPECT_NEAR(found / many.light_of_all(), 1.0, 0.01);
}

TEST(RayAllocation, ChoosesASourceAsOftenAsItSays)
{
    const ManyLamps many(30);
    const RayAllocation shares = allocate_rays(many.sources, kPoint, kRays);
    std::vector<int> chosen(many.sources.count(), 0);
    std::vector<double> said(many.sources.count(), 0.0);
    for (int k = 0; k < kMarks; ++k) {
        const auto [source, chance] = shares.choose((float(k) + 0.5f) / kMarks);
        ++chosen[source];
        said[source] = double(chance);
    }
    double sum = 0.0;
    for (std::size_t s = 0; s < chosen.size(); ++s) {
        sum += said[s];
        EXPECT_NEAR(double(chosen[s]) / kMarks, said[s], 2.0 / kMarks) << s;
    }
    EXPECT_NEAR(sum, 1.0, 1e-3);
    for (const RayAllocation::Own& own : shares.own)
        EXPECT_EQ(chosen[own.source], 0) << "it has rays of its own";
}

TEST(RayAllocation, GivesRaysByWeightAndAboutAsManyAsThereAre)
{
    const ManyLamps many(200);
    const RayAllocation shares = allocate_rays(many.sources, kPoint, kRays);
    std::uint32_t rays = shares.rest_rays;
    double total = 0.0;
    for (std::size_t s = 0; s < many.sources.count(); ++s)
        total += double(many.sources.sampling_weight(s, kPoint));
    for (const RayAllocation::Own& own : shares.own) {
        rays += own.rays;
        const double share = double(many.sources.sampling_weight(own.source, kPoint)) / total;
        EXPECT_NEAR(double(own.rays), share * kRays, 1.0);
    }
    EXPECT_GE(rays, kRays);
    EXPECT_LE(rays, kRays + std::uint32_t(shares.own.size()) + 1u);
}

TEST(RayAllocation, GivesEachOfFewSourcesItsOwn)
{
    const ManyLamps few(4);
    const RayAllocation shares = allocate_rays(few.sources, kPoint, kRays);
    EXPECT_EQ(shares.own.size(), 6u);
    EXPECT_EQ(shares.rest_rays, 0u);
}

TEST(RayAllocation, SourcesBelowThePlaneTakeNoRaysFromThoseAbove)
{
    Scene scene;
    for (const float z : {-0.5f, 2.0f})
        for (const float x : {-1.0f, 0.0f, 1.0f})
            scene.lights.push_back(support::make_lamp(PunctualLight::Kind::point,
                                                      z < 0.0f ? 1e4f : 1.0f, {x, 0.0f, z}));
    const Surfaces surfaces(scene);
    const LightSources sources(scene, surfaces, 4.0f);
    const RayAllocation shares = allocate_rays(sources, kPoint, kRays);
    ASSERT_EQ(shares.own.size(), 3u);
    for (const RayAllocation::Own& own : shares.own) {
        EXPECT_GE(own.source, 3u) << "it is below";
        EXPECT_GE(own.rays, kRays / 4);
    }
    EXPECT_EQ(shares.rest_rays, 0u);
}

TEST(LightSelection, LeavesOutWhatItDoesNotName)
{
    const std::vector<support::Quad> plates = {
        support::plate_above({0.0f, 0.0f}, {1.0f, 1.0f}, 1.0f, glm::vec3(1.0f)),
        support::plate_above({2.0f, 0.0f}, {3.0f, 1.0f}, 1.0f, glm::vec3(1.0f))};
    Scene scene = support::make_quads(plates).scene;
    scene.lights = ManyLamps::lamps(1).lights;
    const Surfaces surfaces(scene);
    const auto parts = [&](const LightSelection& selection) {
        const LightSources sources(scene, surfaces, 2.0f, selection);
        std::vector<std::pair<LightSources::Part, std::uint32_t>> result;
        for (std::size_t s = 0; s < sources.count(); ++s) {
            const LightSources::SourceInfo origin = sources.origin(s);
            const bool lamp = origin.part == LightSources::Part::light;
            result.emplace_back(origin.part, lamp ? origin.index : origin.instance);
        }
        return result;
    };
    using Part = LightSources::Part;
    EXPECT_EQ(parts({}).size(), 5u);
    EXPECT_EQ(parts(kLampsAlone),
              (decltype(parts({})){{Part::light, 0}, {Part::light, 1}, {Part::light, 2}}));
    EXPECT_EQ(parts({.lamps = false, .instances = {1}}),
              (decltype(parts({})){{Part::material, 1}}));
}

}  // namespace
}  // namespace lumel
