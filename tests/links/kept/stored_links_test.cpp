// Light over links of a former run is that of links that were just traced.

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "../../support/source_folder.h"
#include "../../support/temporary_folder.h"
#include "../live/open_box.h"
#include "atlas/prepare/solve_scene.h"
#include "base/core/error.h"
#include "base/core/fingerprint.h"
#include "links/kept/links_file.h"
#include "links/trace/links.h"

namespace lumel {
namespace {

using Lights = std::vector<glm::vec3>;

constexpr int kSide = 64;  // of the atlas [texels]

Scene with_block_moved(Scene scene)
{
    glm::mat4& place = scene.instances[find_instance(scene, "short block")].transform;
    place = glm::translate(glm::mat4(1.0f), glm::vec3(0.04f, 0.0f, 0.05f)) * place;
    return scene;
}

/// Rays per lumel: few, as links are compared one by one.
constexpr LinksOptions kOptions{.seed = 1, .even_rays = 24};

/// A scene and its light, over links of a former run or its own.
struct Lit {
    explicit Lit(Scene scene, const StoredLinks* kept = nullptr)
        : prepared(std::move(scene), AtlasOptions{.size = kSide}),
          light(prepared, kOptions, {})
    {
        solve(kept);
    }
    /// In the atlas of another.
    Lit(Scene scene, const Lit& other, const StoredLinks* kept)
        : prepared(std::move(scene), [&](const Scene&, const RayScene&,
                                         const ProgressCallback&) { return other.prepared.atlas; }),
          light(prepared, kOptions, {})
    {
        solve(kept);
    }
    void solve(const StoredLinks* kept)
    {
        if (kept)
            light.use(*kept, LinkRadiosity::Then::end);
        while (!light.state().ended)
            light.step();
    }
    StoredLinks kept() const { return light.kept("hash"); }

    SolveScene prepared;
    LinkRadiosity light;
};

SolveScene two_rooms(int side = kSide)
{
    return SolveScene(read_gltf(support::source_path("scenes/two-rooms.gltf")),
                      AtlasOptions{.size = side});
}

/// Links of two rounds, of which the second is guided through a door.
StoredLinks guided_links(const SolveScene& scene)
{
    LinkRadiosity light(scene, {}, {});
    for (int rounds = 0; rounds < 2;) {
        const std::uint64_t shots = light.state().shots;
        light.step();
        rounds += light.state().shots > shots ? 1 : 0;
    }
    return light.kept("hash");
}

/// RMS difference, as part of the mean light.
double relative_difference(const Lights& one, const Lights& other)
{
    double square = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        const glm::dvec3 apart = one[i] - other[i];
        square += glm::dot(apart, apart) / 3.0;
        sum += double(other[i].r + other[i].g + other[i].b) / 3.0;
    }
    return std::sqrt(square * double(one.size())) / sum;
}

/// To a target error.
void solve(LinkRadiosity& light, const SolveLimits& limits)
{
    do
        light.step();
    while (!light.state().ended && !(light.state().shots > 0 && light.state().error >= 0.0 &&
                                     light.state().error <= limits.target_error));
}

/// Over all stored rounds.
void solve_over(const StoredLinks& kept, LinkRadiosity& light)
{
    light.use(kept, LinkRadiosity::Then::end);
    while (!light.state().ended)
        light.step();
}

std::size_t different_links(const StoredLinks& one, const StoredLinks& other)
{
    std::size_t count = 0;
    for (std::size_t r = 0; r < one.rounds.size(); ++r)
        for (std::size_t k = 0; k < kSolutions; ++k) {
            const std::vector<LinkEnd>&a = one.rounds[r].ends[k], &b = other.rounds[r].ends[k];
            const auto [least, most] = std::minmax({a.size(), b.size()});
            count += most - least;  // by lumels that are buried in one of both
            for (std::size_t n = 0; n < least; ++n)
                count += a[n] != b[n] ? 1 : 0;
        }
    return count;
}

/// Rays whose end is not stored: their first hit is near.
std::size_t near_links(const StoredLinks& links)
{
    std::size_t count = 0;
    for (const StoredLinks::Round& round : links.rounds)
        for (const std::vector<LinkEnd>& ends : round.ends)
            for (const LinkEnd end : ends)
                count += end.number() == LinkNumbers::kNear ? 1 : 0;
    return count;
}

StoredLinks through_a_file(const StoredLinks& kept)
{
    const test::TemporaryFolder folder;
    const std::string path = folder / "scene.lumellinks";
    write_links(path, kept);
    return read_links(path);
}

TEST(KeptLight, OfOtherLampsAndSkyOverLinksFromAFileIsThatOfANewTracing)
{
    const StoredLinks kept = through_a_file(Lit(test::open_box()).kept());
    Scene scene = test::open_box();
    scene.lights[0].transform[3] = glm::vec4(0.4f, 0.45f, 0.1f, 1.0f);
    for (glm::vec3& radiance : scene.sky.radiance)
        radiance *= glm::vec3(0.3f, 0.3f, 0.6f);
    for (Material& material : scene.materials)
        material.emitted *= 0.4f;
    Lit over(scene, &kept), anew(scene);
    EXPECT_EQ(over.light.traced(), near_links(kept));
    EXPECT_LT(over.light.traced(), anew.light.traced() / 4);
    EXPECT_EQ(different_links(over.kept(), anew.kept()), 0u);
    EXPECT_EQ(over.light.irradiance(), anew.light.irradiance());
    EXPECT_EQ(over.light.state().error, anew.light.state().error);
}

/// Each state after the first is found by a solver that has lit others.
TEST(KeptLight, OfSeveralStatesByOneSolverIsThatOfNewOnes)
{
    const StoredLinks kept = Lit(test::open_box()).kept();
    Lit over(test::open_box(), &kept);
    const auto expect_as_anew = [&] {
        over.prepared.surfaces = Surfaces(over.prepared.scene);
        over.light.relight();
        over.solve(nullptr);
        Lit anew(over.prepared.scene, &kept);
        EXPECT_EQ(over.light.irradiance(), anew.light.irradiance());
        EXPECT_EQ(over.light.state().error, anew.light.state().error);
        EXPECT_EQ(over.light.state().shots, anew.light.state().shots);
        EXPECT_EQ(over.light.traced(), anew.light.traced());
    };
    Scene& scene = over.prepared.scene;
    scene.lights[0].transform[3] = glm::vec4(0.4f, 0.45f, 0.1f, 1.0f);
    expect_as_anew();
    scene.sky.radiance.assign(scene.sky.radiance.size(), glm::vec3(2.0f));  // no bright part
    for (Material& material : scene.materials)
        material.emitted *= 0.4f;
    expect_as_anew();
    scene.lights.clear();
    scene.sky = {};
    expect_as_anew();
    const Scene given = test::open_box();
    scene.lights = given.lights;
    scene.sky = given.sky;
    expect_as_anew();
}

TEST(KeptLight, ByASolverOfItsOwnLinksIsThatOfANewOne)
{
    Lit light(test::open_box());
    light.prepared.scene.lights[0].color = glm::vec3(0.2f, 0.5f, 1.0f);
    light.light.relight();
    light.solve(nullptr);
    Lit anew(light.prepared.scene);
    EXPECT_EQ(light.light.irradiance(), anew.light.irradiance());
}

TEST(KeptLight, ThroughColouredGlassIsThatOfANewTracing)
{
    Scene scene = test::open_box();
    const std::uint32_t block = find_instance(scene, "tall block");
    for (const Primitive& primitive :
         scene.meshes[std::size_t(scene.instances[block].mesh)].primitives) {
        Material& glass = scene.materials[std::size_t(primitive.material)];
        glass.transmission = 0.9f;
        glass.base_color = glm::vec4(0.4f, 0.9f, 0.6f, 1.0f);
    }
    const StoredLinks kept = Lit(scene).kept();
    scene.lights[0].color = glm::vec3(0.2f, 0.5f, 1.0f);
    Lit over(scene, &kept), anew(scene);
    EXPECT_EQ(over.light.irradiance(), anew.light.irradiance());
}

TEST(KeptLight, OfAThingThatMovedTracesFewLinksAndIsThatOfANewTracing)
{
    const Lit before(test::open_box());
    const StoredLinks kept = before.kept();
    const Scene scene = with_block_moved(test::open_box());
    Lit over(scene, before, &kept), anew(scene, before, nullptr);
    ASSERT_EQ(over.prepared.lumels.lumels.size(), kept.lumels.size());
    EXPECT_GT(over.light.traced(), near_links(kept));
    EXPECT_LT(over.light.traced(), anew.light.traced() / 2);
    EXPECT_GT(different_links(kept, anew.kept()), 0u);
    EXPECT_EQ(different_links(over.kept(), anew.kept()), 0u);
    EXPECT_EQ(over.light.irradiance(), anew.light.irradiance());
}

TEST(KeptLight, OfABlendedThingThatMovedIsThatOfANewTracing)
{
    Scene scene = test::open_box();
    const std::uint32_t block = find_instance(scene, "short block");
    for (const Primitive& primitive :
         scene.meshes[std::size_t(scene.instances[block].mesh)].primitives) {
        Material& veil = scene.materials[std::size_t(primitive.material)];
        veil.alpha_mode = AlphaMode::blend;
        veil.base_color.a = 0.5f;
    }
    const Lit before(scene);
    const StoredLinks kept = before.kept();
    const Scene moved = with_block_moved(scene);
    Lit over(moved, before, &kept), anew(moved, before, nullptr);
    EXPECT_EQ(different_links(over.kept(), anew.kept()), 0u);
    EXPECT_EQ(over.light.irradiance(), anew.light.irradiance());
}

TEST(KeptLinks, OfABakeThatIsStoppedWithinARoundAreThoseOfWholeRounds)
{
    const SolveScene scene(test::open_box(), AtlasOptions{.size = kSide});
    LinkRadiosity light(scene, {}, {.target_error = 1e-3});
    for (int rounds = 0; rounds < 2;) {
        const std::uint64_t shots = light.state().shots;
        light.step();
        rounds += light.state().shots > shots ? 1 : 0;
        if (rounds > 0) {
            EXPECT_EQ(light.kept("hash").shots(), light.state().shots);
        }
    }
}

TEST(KeptLight, OverLinksOfAnotherSeedTracesAllOfThem)
{
    StoredLinks kept = Lit(test::open_box()).kept();
    kept.seed = 2;
    const Lit over(test::open_box(), &kept);
    EXPECT_EQ(over.light.traced(), Lit(test::open_box()).light.traced());
}

TEST(KeptLight, OverGuidedLinksIsThatOfTracingThemAgain)
{
    const SolveScene scene = two_rooms();
    const StoredLinks kept = through_a_file(guided_links(scene));
    ASSERT_FALSE(kept.guide.empty());
    ASSERT_EQ(kept.rounds.size(), 2u);
    StoredLinks to_trace = kept;
    for (StoredLinks::Round& round : to_trace.rounds)
        for (std::vector<LinkEnd>& ends : round.ends)
            std::ranges::fill(ends, LinkEnd::of(LinkNumbers::kNear));
    LinkRadiosity over(scene, {}, {}), anew(scene, {}, {});
    solve_over(kept, over);
    solve_over(to_trace, anew);
    EXPECT_EQ(over.traced(), near_links(kept));
    EXPECT_LT(over.traced(), anew.traced() / 4);
    EXPECT_EQ(different_links(over.kept("hash"), kept), 0u);
    EXPECT_EQ(different_links(anew.kept("hash"), kept), 0u);
    EXPECT_EQ(over.irradiance(), anew.irradiance());
}

/// Shadow rays by need are those of the bake, also if a looser target is reached without them.
TEST(KeptLight, OverRefinedDirectLightIsThatOfTheBake)
{
    const SolveScene scene = two_rooms();
    const SolveLimits limits{.target_error = 0.002};
    LinkRadiosity bake(scene, {}, limits, Parts::direct);
    solve(bake, limits);
    const StoredLinks kept = through_a_file(bake.kept("hash"));
    ASSERT_FALSE(kept.passes.empty());
    LinkRadiosity over(scene, {}, limits, Parts::direct);
    over.use(kept, LinkRadiosity::Then::end);
    for (int state = 0; state < 2; ++state) {
        solve(over, {.target_error = 10.0 * limits.target_error});
        EXPECT_EQ(over.irradiance(), bake.irradiance()) << state;
        EXPECT_EQ(over.kept("hash").passes.size(), kept.passes.size()) << state;
        over.relight();
    }
}

/// Sweeps that went on from round to round leave another residual than those begun anew.
TEST(KeptLight, OfABakeByNeedIsItsLight)
{
    constexpr double kResidual = 1e-3;  // where sweeps stop
    const SolveScene scene = two_rooms();
    const SolveLimits limits{.target_error = 0.003};
    LinkRadiosity bake(scene, {}, limits);
    solve(bake, limits);
    StoredLinks kept = through_a_file(bake.kept("hash"));
    ASSERT_GT(kept.rounds.size(), 1u);
    ASSERT_FALSE(kept.passes.empty());
    EXPECT_LT(kept.passes.front().rounds, kept.rounds.size());
    const auto off = [&] {
        LinkRadiosity over(scene, {}, limits);
        over.use(kept, LinkRadiosity::Then::end);
        solve(over, limits);
        return relative_difference(over.irradiance(), bake.irradiance());
    };
    EXPECT_LT(off(), kResidual);
    kept.passes.clear();
    EXPECT_GT(off(), kResidual);
}

/// A time limit can end a state before its last pass: its errors are unknown then.
TEST(KeptLight, BeforeItsLastPassHasNoErrors)
{
    const SolveScene scene = two_rooms();
    const SolveLimits limits{.target_error = 0.003};
    LinkRadiosity bake(scene, {}, limits), over(scene, {}, limits);
    solve(bake, limits);
    const StoredLinks kept = bake.kept("hash");
    ASSERT_FALSE(kept.passes.empty());
    over.use(kept, LinkRadiosity::Then::end);
    int before = 0;
    SolverState state;
    do {
        over.step();
        state = over.state();
        if (state.shots == 0 || state.error >= 0.0)
            continue;
        ++before;
        EXPECT_LT(state.dark_error, 0.0);
        EXPECT_LT(state.eye_error, 0.0);
        EXPECT_LT(state.seen_noise(), 0.0);
    } while (!state.ended && (state.error < 0.0 || state.error > limits.target_error));
    EXPECT_GT(before, 0);
    EXPECT_GE(state.error, 0.0);
    EXPECT_GE(state.seen_noise(), 0.0);
}

/// A limit of rays ends a bake right after a round, when a pass is scheduled.
TEST(KeptLinks, AreWithoutThePassThatDidNotRun)
{
    const SolveScene scene = two_rooms();
    const SolveLimits limits{.target_error = 0.003};
    LinkRadiosity bake(scene, {}, limits), stopped(scene, {}, limits);
    solve(bake, limits);
    const StoredLinks kept = bake.kept("hash");
    ASSERT_FALSE(kept.passes.empty());
    const auto steps_to = [&](std::size_t rounds) {
        do
            stopped.step();
        while (stopped.state().shots == 0 || stopped.kept("hash").rounds.size() < rounds);
    };
    steps_to(kept.passes.front().rounds);
    EXPECT_TRUE(stopped.kept("hash").passes.empty());
}

/// Passes for the light of one lamp do not keep those from starting that another needs.
TEST(KeptLight, UnderAnotherLampReachesTheErrorOfItsBake)
{
    constexpr double kTarget = 0.01;
    const auto lit_from = [](float x) {
        Scene scene = test::open_box();
        PunctualLight lamp{.kind = PunctualLight::Kind::point, .name = "lamp"};
        lamp.transform = glm::translate(glm::mat4(1.0f), {x, 0.45f, 0.3f});
        lamp.intensity = 10.0f;
        lamp.radius = 0.05f;
        scene.lights = {lamp};
        return SolveScene(std::move(scene), AtlasOptions{.size = kSide});
    };
    const SolveLimits limits{.target_error = kTarget};
    const SolveScene left = lit_from(0.1f), right = lit_from(0.45f);
    LinkRadiosity bake(left, {}, limits, Parts::direct);
    solve(bake, limits);
    const StoredLinks kept = bake.kept("hash");
    ASSERT_FALSE(kept.passes.empty());
    LinkRadiosity over(right, {}, limits, Parts::direct);
    over.use(kept, LinkRadiosity::Then::end);
    solve(over, limits);
    EXPECT_LE(over.state().error, kTarget);
}

/// Its lumels are others than those that the guide was learnt for.
TEST(KeptLight, OverGuidedLinksOfAnotherAtlasIsNotGuided)
{
    const StoredLinks kept = guided_links(two_rooms());
    ASSERT_FALSE(kept.guide.empty());
    const SolveScene finer = two_rooms(2 * kSide);
    ASSERT_GT(finer.lumels.lumels.size(), kept.lumels.size());
    LinkRadiosity over(finer, {}, {});
    solve_over(kept, over);
    EXPECT_TRUE(over.kept("hash").guide.empty());
}

TEST(KeptLinks, TakeTheirGuideAlongWhenLumelsGetOtherNumbers)
{
    const StoredLinks kept = guided_links(two_rooms());
    const std::size_t lumels = kept.lumels.size(), instances = kept.instances.size();
    Renumbering now{.lumels_now = lumels + 1, .instances_now = instances};
    for (std::uint32_t i = 0; i < instances; ++i)
        now.instances.push_back(i);
    for (std::uint32_t i = 0; i < lumels; ++i)  // one before all others is new
        now.lumels.push_back(i + 1);
    const RayGuide moved = renumbered(kept, now).guide;
    ASSERT_TRUE(moved.fits(lumels + 1));
    EXPECT_EQ(moved.group[0], 0u);
    for (std::size_t i = 0; i < lumels; ++i)
        EXPECT_EQ(moved.group[i + 1], kept.guide.group[i]);
    ASSERT_EQ(moved.tables.size(), kept.guide.tables.size());
    for (std::size_t g = 0; g < moved.tables.size(); ++g)
        for (std::size_t k = 0; k < kSolutions; ++k) {
            EXPECT_EQ(moved.tables[g][k].probabilities, kept.guide.tables[g][k].probabilities);
            EXPECT_EQ(moved.tables[g][k].gain, kept.guide.tables[g][k].gain);
        }
}

TEST(KeptLinks, ComeBackFromAFileAsTheyWere)
{
    const StoredLinks kept = Lit(test::open_box()).kept(), read = through_a_file(kept);
    EXPECT_EQ(read.scene_hash, "hash");
    EXPECT_EQ(read.seed, kept.seed);
    EXPECT_EQ(read.shots(), 24u);
    EXPECT_EQ(read.lumels, kept.lumels);
    EXPECT_EQ(read.instances, kept.instances);
    ASSERT_EQ(read.rounds.size(), 1u);
    EXPECT_EQ(read.rounds[0].rays, kept.rounds[0].rays);
    EXPECT_EQ(read.rounds[0].ends, kept.rounds[0].ends);
    ASSERT_EQ(read.sheets.size(), kept.sheets.size());
    for (std::size_t s = 0; s < kept.sheets.size(); ++s)
        EXPECT_EQ(read.sheets[s].texcoord, kept.sheets[s].texcoord);
}

TEST(KeptLinks, FromADamagedFileAreRefused)
{
    const test::TemporaryFolder folder;
    const std::string path = folder / "scene.lumellinks";
    EXPECT_THROW(read_links(path), Error);
    StoredLinks kept = Lit(test::open_box()).kept();
    kept.rounds[0].ends[1][5] = LinkEnd::of(kept.numbers().count());  // beyond the last
    write_links(path, kept);
    EXPECT_THROW(read_links(path), Error);
    kept.rounds[0].ends[1][5] = LinkEnd::of(LinkNumbers::kSky);
    write_links(path, kept);
    read_links(path);
    const auto refuses = [&](const StoredLinks::Pass& pass) {
        kept.passes = {pass};
        write_links(path, kept);
        EXPECT_THROW(read_links(path), Error);
    };
    const std::size_t lumels = kept.lumels.size();
    refuses({.rounds = 2, .levels = std::vector<std::uint8_t>(lumels)});
    refuses({.aim = ErrorOf(4), .levels = std::vector<std::uint8_t>(lumels)});
    refuses({.levels = std::vector<std::uint8_t>(lumels, DirectEstimator::kMaxLevel + 1)});
    refuses({.levels = std::vector<std::uint8_t>(lumels - 1)});
    kept.passes.clear();
    write_links(path, kept);
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(1000);
    file.put('?');
    file.close();
    EXPECT_THROW(read_links(path), Error);
}

/// A file whose contents have any byte changed, and vouch for themselves again.
TEST(KeptLinks, ForgedAreRefusedOrSound)
{
    constexpr std::size_t kHead = 32, kFingerprint = 24;  // [bytes]
    const test::TemporaryFolder folder;
    const std::string path = folder / "scene.lumellinks";
    StoredLinks kept{.scene_hash = "hash",
                     .ray_offset = 0.1f,
                     .lumels = {1, 2, 3},
                     .instances = {4},
                     .boxes = {Box{}}};
    kept.rounds = {{.mean = 1.0}};
    kept.rounds[0].rays.fill({1, 0, 2});
    for (std::vector<LinkEnd>& ends : kept.rounds[0].ends)
        ends = {LinkEnd::of(LinkNumbers::kSky), LinkEnd::of(kept.numbers().of_part(1), 15),
                LinkEnd::of(LinkNumbers::kNear)};
    kept.sheets = {{.texcoord = {{0, 0}, {1, 0}, {0, 1}}, .chart = {0}}};
    kept.side = 8;
    kept.charts = 1;
    write_links(path, kept);
    EXPECT_EQ(read_links(path).rounds[0].ends, kept.rounds[0].ends);
    std::ifstream file(path, std::ios::binary);
    const std::string given{std::istreambuf_iterator<char>(file), {}};
    std::size_t refused = 0, tried = 0;
    for (std::size_t at = kHead; at < given.size(); ++at)
        for (const char forged : {'\x00', '\x01', '\x7f', '\xff'}) {
            std::string bytes = given;
            bytes[at] = forged;
            Fingerprint print;
            print.add_bytes(bytes.data() + kHead, bytes.size() - kHead);
            const std::uint64_t value = print.value();
            std::memcpy(bytes.data() + kFingerprint, &value, sizeof value);
            std::ofstream(path, std::ios::binary) << bytes;
            ++tried;
            try {
                const StoredLinks read = read_links(path);
                for (const StoredLinks::Round& round : read.rounds)
                    for (std::size_t k = 0; k < kSolutions; ++k) {
                        EXPECT_EQ(round.ends[k].size(), first_rays(round.rays[k]).back());
                        for (const LinkEnd end : round.ends[k])
                            EXPECT_LT(end.number(), read.numbers().count());
                    }
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), ErrorKind::input);
                ++refused;
            }
        }
    EXPECT_GT(refused, tried / 5);
    EXPECT_LT(refused, tried);
}

}  // namespace
}  // namespace lumel
