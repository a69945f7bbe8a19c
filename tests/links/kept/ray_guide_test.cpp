// Guided rays: their density, and that their weights keep the light what it is.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "../../support/source_folder.h"
#include "atlas/cells/order.h"
#include "links/kept/ray_guide.h"
#include "links/rays/tracer.h"
#include "links/sweeps/source_term.h"
#include "rays/cast/ray_caster.h"

namespace lumel {
namespace {

/// Points in the unit square, evenly distributed.
constexpr std::uint32_t kPoints = 1u << 18;

template <class Visit>
void for_each_point(const Visit& visit)
{
    for (std::uint32_t n = 0; n < kPoints; ++n)
        visit(PathSamples(1, n).stratified(0));
}

/// What uniform rays tell of `light`.
template <class Light>
std::optional<RayGuide::Table> learnt_from(const Light& light)
{
    GuideMoments moments;
    std::size_t k = 0;
    for_each_point([&](const glm::vec2& point) {
        moments.add(k++ % kSolutions, RayGuide::bin_of(point), light(point));
    });
    return moments.find();
}

/// A sunlit patch in a dim room: a hundredth of the square.
double patch(const glm::vec2& point)
{
    return glm::distance(point, {0.3f, 0.7f}) < 0.0564f ? 100.0 : 0.5;
}

TEST(RayGuide, DrawsEachBinAsOftenAsItsProbabilitySays)
{
    const std::optional<RayGuide::Table> found = learnt_from(patch);
    ASSERT_TRUE(found);
    const GuidedDraw draw(found->front().probabilities);
    std::vector<double> count(RayGuide::kBins, 0.0);
    for_each_point([&](const glm::vec2& uniform) {
        const GuidedDraw::Drawn drawn = draw(uniform);
        ASSERT_EQ(drawn.bin, RayGuide::bin_of(drawn.point));
        count[drawn.bin] += 1.0 / kPoints;
    });
    for (std::uint32_t b = 0; b < RayGuide::kBins; ++b) {
        const double wanted = double(found->front().probabilities[b]) / RayGuide::kOne;
        EXPECT_NEAR(count[b], wanted, 0.02 * wanted + 2e-5) << b;
    }
}

TEST(RayGuide, KeepsTheMeanAndLowersTheVariance)
{
    const std::optional<RayGuide::Table> found = learnt_from(patch);
    ASSERT_TRUE(found);
    const GuidedDraw draw(found->front().probabilities);
    const auto moments = [](const auto& sample) {
        glm::dvec2 sums(0.0);
        for_each_point([&](const glm::vec2& uniform) {
            const double light = sample(uniform);
            sums += glm::dvec2(light, light * light) / double(kPoints);
        });
        return glm::dvec2(sums.x, sums.y - sums.x * sums.x);
    };
    const glm::dvec2 even = moments(patch),
                     guided = moments([&](const glm::vec2&uniform) {
                         const GuidedDraw::Drawn drawn = draw(uniform);
                         return double(RayGuide::weight(found->front().probabilities[drawn.bin],
                                                        0.0f, 1.0f)) *
                                patch(drawn.point);
                     });
    EXPECT_NEAR(guided.x, even.x, 0.005 * even.x);
    EXPECT_LT(guided.y, even.y / 5.0);
    EXPECT_NEAR(found->front().gain, even.y / guided.y, 0.1 * found->front().gain);
}

TEST(RayGuide, LeavesEvenLightToUniformRays)
{
    EXPECT_FALSE(learnt_from([](const glm::vec2&) { return 3.0; }));
    EXPECT_FALSE(learnt_from([](const glm::vec2& point) { return 1.0 + 0.5 * double(point.y); }));
}

/// One ray of a solution found a lamp that those of the others missed: nothing is known of it.
TEST(RayGuide, DoesNotFollowWhatOneSolutionAloneHasSeen)
{
    GuideMoments moments;
    for (std::size_t k = 0; k < kSolutions; ++k)
        for (std::uint32_t b = 0; b < RayGuide::kBins; ++b)
            moments.add(k, b, 1.0);
    moments.add(0, 17, 1000.0);
    EXPECT_FALSE(moments.find());
}

TEST(RayGuide, RefusesProbabilitiesThatNoRayCouldHave)
{
    RayGuide guide{{0, 0}, {RayGuide::all_uniform()}};
    EXPECT_TRUE(guide.fits(2));
    EXPECT_FALSE(guide.fits(3));
    guide.group[1] = 1;
    EXPECT_FALSE(guide.fits(2));
    guide.group[1] = 0;
    guide.tables[0][1].gain = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(guide.fits(2));
    guide.tables[0][1].gain = 1.0f;
    guide.tables[0][1].probabilities[5] = 0;
    EXPECT_FALSE(guide.fits(2));
}

/// Light of the first bounce and the sky, in a room with a lamp, by uniform rays and by rays of
/// wildly uneven probabilities.
TEST(RayGuide, UnevenRaysBringTheSameLight)
{
    const SolveScene scene(support::source_path("scenes/room.gltf"), {.size = 128});
    const LinkWork work(scene, {cast_on_host(scene.rays)}, SampleRule::area, order_in_space);
    const SubLumels parts(work.world, work.cells, scene.rays, scene.lumels, work.order,
                          kPartStream);
    DirectEstimator direct(work, kDirectStream);
    while (direct.step()) {
    }
    const LinkNumbers numbers(scene.scene.instances.size(), parts.count());
    const LinkTracer tracer(work, parts, numbers, direct, 1);

    RayGuide guide{std::vector<std::uint32_t>(work.order.size(), 1),
                   {RayGuide::all_uniform(), RayGuide::all_uniform()}};
    for (RayGuide::OfSolution& of : guide.tables[1])
        for (std::uint32_t b = 0; b < RayGuide::kBins; ++b)
            of.probabilities[b] = std::uint16_t(b % 2 == 0 ? 64 : 448);
    ASSERT_TRUE(guide.fits(work.order.size()));

    const auto light_by = [&](const RayGuide* by) {
        LinkTable links(parts.count());
        for (const std::uint16_t rays : {std::uint16_t(64), std::uint16_t(192)}) {
            const std::vector<std::uint16_t> each(work.order.size(), rays);
            const auto round = std::uint32_t(links.rounds.size());
            links.rounds.emplace_back(tracer.blocks());
            tracer.trace(0, tracer.blocks(), {each, round, 0, nullptr, by}, links);
        }
        if (by)
            tracer.weigh(*by, 0, links);
        EXPECT_TRUE(links.fits(work, parts, numbers, tracer.blocks(), 0, by != nullptr));
        const SourceTerm source = find_source_term(
            work, parts, numbers, ReflectedLight(work, parts, numbers, direct), links);
        glm::dvec3 sum(0.0);
        for (std::uint32_t p = 0; p < parts.count(); ++p)
            if (source.rays[p] > 0.0f)
                sum += glm::dvec3(source.light[p]) / double(source.rays[p]);
        return sum / double(parts.count());
    };
    const glm::dvec3 even = light_by(nullptr), uneven = light_by(&guide);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(uneven[c], even[c], 0.01 * even[c]);
}

}  // namespace
}  // namespace lumel
