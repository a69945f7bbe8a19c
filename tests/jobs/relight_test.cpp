// What a stored matrix makes of a scene's lights.

#include <chrono>
#include <fstream>
#include <numeric>

#include "../support/input_error.h"
#include "base/core/fingerprint.h"
#include "base/core/frame.h"
#include "base/core/luminance.h"
#include "jobs/inspect/why.h"
#include "jobs/solve/sources.h"
#include "lights/light_sources.h"
#include "methods/matrix/matrix_file.h"
#include "methods/matrix/relight_session.h"
#include "results/measure/contributors.h"
#include "solve/matrix/stored.h"
#include "solved.h"

namespace lumel {
namespace {

constexpr int kSize = 32;  // of the atlas [texels]

/// The Cornell box under a sky, with a lamp in it beside its own.
struct Lit {
    explicit Lit(const std::vector<PunctualLight>& lamps = {lamp()},
                 MatrixForm form = MatrixForm::tiles)
        : setting(scene(lamps), &device, options(form), stages),
          solution(solve_sources(device, setting, options(form), stages))
    {
    }

    static BakeOptions options(MatrixForm form)
    {
        MatrixOptions method{.form = form};
        method.transport.patches = 150;
        BakeOptions options;
        options.solver.method = method;
        options.solver.target_error = 0.03;
        options.atlas.size = kSize;
        options.sky_directions = 64;
        return options;
    }
    static PunctualLight lamp()
    {
        PunctualLight lamp{.name = "lamp", .intensity = 0.1f};
        lamp.transform[3] = glm::vec4(0.45f, 0.3f, 0.1f, 1.0f);
        return lamp;
    }
    static Scene scene(const std::vector<PunctualLight>& lamps)
    {
        Scene scene = read_scene(support::scene_path("cornell-box"), MaterialModel::diffuse,
                                 {.sky_color = glm::vec3(1.0f, 2.0f, 4.0f)});
        scene.lights = lamps;
        return scene;
    }

    const ProgressFunction progress;
    Stages stages{progress};
    gpu::Device device;
    Setting setting;
    std::unique_ptr<Solution> solution;
};

void expect_alike(const std::vector<glm::vec3>& found, const std::vector<glm::vec3>& wanted,
                  float tolerance)
{
    ASSERT_EQ(found.size(), wanted.size());
    double square = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        square += double(glm::dot(found[i] - wanted[i], found[i] - wanted[i])) / 3.0;
        sum += double(wanted[i].r + wanted[i].g + wanted[i].b) / 3.0;
    }
    const double n = double(found.size());
    EXPECT_LT(std::sqrt(square / n) / (sum / n), double(tolerance));
}

/// The mean difference is at least this share of the mean.
void expect_apart(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, double least)
{
    double apart = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        apart += double(glm::length(a[i] - b[i]));
        sum += double(glm::length(b[i]));
    }
    EXPECT_GT(apart, least * sum);
}

std::vector<glm::vec3> sum_of(std::vector<glm::vec3> a, const std::vector<glm::vec3>& b)
{
    for (std::size_t i = 0; i < a.size(); ++i)
        a[i] += b[i];
    return a;
}

constexpr float kHalfRounding = 1e-3f;  // of stored light
constexpr float kMatrixError = 3e-3f;   // of the compressed matrix, which aims at 0.2 %
constexpr float kPapersError = 0.03f;   // of its form, which "hardly differs" [SF17]
constexpr float kCutBelow = 1e-3f;      // where a lumel's weights would make its light negative

TEST(Relighting, IsTheSolutionAndLinearInItsFactors)
{
    Lit lit;
    ASSERT_TRUE(lit.solution->relightable);
    RelightSession session(lit.device, *lit.solution->relightable);
    EXPECT_EQ(session.names(), (std::vector<std::string>{"sky", "lamp", "light"}));
    const std::vector<glm::vec3> all = session.irradiance();
    expect_alike(all, lit.solution->irradiance, kMatrixError);

    session.set_light("sky", glm::vec3(0.0f));
    const std::vector<glm::vec3> rest = session.irradiance();
    const LightState sky{.others = glm::vec3(0.0f), .lights = {{"sky", glm::vec3(1.0f)}}};
    const LightState red{.others = glm::vec3(0.0f), .lights = {{"sky", glm::vec3(2, 0, 0)}}};
    const std::vector<std::vector<glm::vec3>> states =
        session.irradiance(std::vector<LightState>{sky, red});
    expect_alike(sum_of(rest, states[0]), all, kCutBelow);
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_NEAR(states[1][i].r, 2.0f * states[0][i].r, 1e-5f * states[0][i].r);
        EXPECT_EQ(states[1][i].g, 0.0f);
        EXPECT_EQ(states[1][i].b, 0.0f);
    }
    EXPECT_EQ(lit.device.validation_messages(), "");
}

/// The light of one source.
std::vector<glm::vec3> alone(RelightSession& session, const std::string& source)
{
    const LightState state{.others = glm::vec3(0.0f), .lights = {{source, glm::vec3(1.0f)}}};
    return session.irradiance(std::span(&state, 1)).front();
}

TEST(Relighting, ByThePapersFormIsTheSolutionAndThatByTilesWithinAFewPerCent)
{
    Lit papers({Lit::lamp()}, MatrixForm::bc1), tiles;
    if (!papers.device.can_read_blocks())
        GTEST_SKIP() << "the device has no block textures";
    const Relightable& light = *papers.solution->relightable;
    ASSERT_TRUE(std::holds_alternative<Bc1Matrix>(light.matrix));
    RelightSession session(papers.device, light);
    RelightSession other(tiles.device, *tiles.solution->relightable);
    expect_alike(session.irradiance(), papers.solution->irradiance, kPapersError);
    for (const std::string& source : session.names())
        expect_alike(alone(session, source), alone(other, source), kPapersError);
    EXPECT_EQ(papers.device.validation_messages(), "");
}

TEST(Relighting, AHundredStatesAreThoseOneByOne)
{
    Lit lit;
    RelightSession session(lit.device, *lit.solution->relightable);
    std::vector<LightState> states;
    for (int i = 0; i < 100; ++i)
        states.push_back({.others = glm::vec3(0.01f * float(i)),
                          .lights = {{"lamp", glm::vec3(1.0f, 0.02f * float(i), 0.0f)}}});
    const auto start = std::chrono::steady_clock::now();
    const std::vector<std::vector<glm::vec3>> maps = session.irradiance(states);
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    std::printf("%.3f ms a state\n", ms / 100.0);
    ASSERT_EQ(maps.size(), states.size());
    for (const std::size_t i : {0u, 15u, 16u, 57u, 99u}) {
        session.set_light("sky", states[i].others);
        session.set_light("light", states[i].others);
        session.set_light("lamp", states[i].lights["lamp"]);
        expect_alike(maps[i], session.irradiance(), 1e-6f);
    }
}

TEST(Relighting, KnowsSurfacesByTheirMaterialAndRefusesOtherNames)
{
    Lit lit;
    RelightSession session(lit.device, *lit.solution->relightable);
    Relightable renamed = *lit.solution->relightable;
    for (SourceLight& source : renamed.sources)
        if (source.name == "light")
            source.name = "ceiling lamp";
    RelightSession other(lit.device, renamed);
    other.set_light("light", glm::vec3(0.3f));  // the material's name
    session.set_light("light", glm::vec3(0.3f));
    EXPECT_EQ(other.irradiance(), session.irradiance());
    const LightState twice{.lights = {{"light", glm::vec3(1.0f)}, {"ceiling lamp", {}}}};
    EXPECT_THROW(other.check(twice), Error);
    EXPECT_THROW(session.set_light("moon", glm::vec3(1.0f)), Error);
    EXPECT_THROW(session.set_light("sky", glm::vec3(-1.0f)), Error);
    EXPECT_THROW(session.set_light("sky", glm::vec3(NAN)), Error);
}

/// The session of a solution, in which lamps may move.
struct Moving {
    explicit Moving(const Lit& lit) : session(lit.device, *lit.solution->relightable)
    {
        const Lumels& lumels = lit.setting.prepared.lumels;
        std::vector<std::uint32_t> number(lumels.lumels.size());
        std::iota(number.begin(), number.end(), 0u);
        session.set_world({*lit.setting.world, lumels, number, {}});
    }
    RelightSession session;
};

// One matrix serves all places of a lamp.
TEST(Relighting, WithALampThatMovedIsASolutionWithTheLampThere)
{
    const glm::vec3 place(0.12f, 0.5f, 0.3f);
    PunctualLight there = Lit::lamp();
    there.transform[3] = glm::vec4(place, 1.0f);
    Lit lit, fresh({there});
    Moving moving(lit);
    const std::vector<glm::vec3> before = moving.session.irradiance();
    const LightState state{.places = {{"lamp", {.position = glm::dvec3(place)}}}};
    const std::vector<glm::vec3> found = moving.session.irradiance(std::span(&state, 1)).front();
    expect_alike(found, fresh.solution->irradiance, kMatrixError);
    expect_apart(found, before, 0.1);

    moving.session.move_light("lamp", {.position = glm::dvec3(place)});
    EXPECT_EQ(moving.session.irradiance(), found);
    moving.session.move_light("lamp", {});
    expect_alike(moving.session.irradiance(), before, kHalfRounding);
    EXPECT_EQ(lit.device.validation_messages(), "");
}

TEST(Relighting, WithLampsThatTurnedIsASolutionWithThemTurned)
{
    PunctualLight spot{.kind = PunctualLight::Kind::spot, .name = "spot", .intensity = 3.0f};
    spot.transform[3] = Lit::lamp().transform[3];
    PunctualLight sun{.kind = PunctualLight::Kind::directional, .name = "sun", .intensity = 10.0f};
    const auto turned = [](PunctualLight lamp, const glm::vec3& direction) {
        const glm::vec4 position = lamp.transform[3];
        lamp.transform = glm::mat4(frame_about(-glm::normalize(direction)));
        lamp.transform[3] = position;
        return lamp;
    };
    const glm::vec3 down(0.1f, -1.0f, 0.2f), aside(-0.8f, 0.1f, 0.3f);
    const glm::vec3 high(0.1f, -0.6f, 1.0f), low(-0.4f, -0.2f, 1.0f);
    Lit lit({turned(spot, down), turned(sun, high)});
    Lit fresh({turned(spot, aside), turned(sun, low)});
    Moving moving(lit);
    const LightState state{
        .places = {{"spot", {.direction = aside}}, {"sun", {.direction = 10.0f * low}}}};
    const std::vector<glm::vec3> found = moving.session.irradiance(std::span(&state, 1)).front();
    expect_alike(found, fresh.solution->irradiance, kMatrixError);
    expect_apart(found, moving.session.irradiance(), 0.1);
}

TEST(Relighting, MovesNothingButSingleLamps)
{
    Lit lit;
    Moving moving(lit);
    RelightSession without(lit.device, *lit.solution->relightable);
    const LampPlace place{.position = glm::dvec3(0.1)};
    EXPECT_THROW(without.move_light("lamp", place), Error);
    EXPECT_THROW(moving.session.move_light("sky", place), Error);
    EXPECT_THROW(moving.session.move_light("light", place), Error);
    EXPECT_THROW(moving.session.move_light("moon", place), Error);
    EXPECT_THROW(moving.session.move_light("lamp", {.position = glm::dvec3(NAN)}), Error);
    EXPECT_THROW(moving.session.move_light("lamp", {.direction = glm::vec3(0.0f)}), Error);
}

// Each source costs a solve, so that a hall of many lamps has few.
TEST(LightSources, OfManyInstancesAreTheirMaterials)
{
    Scene scene;
    scene.materials = {{.name = "warm", .emitted = glm::vec3(2, 1, 1)},
                       {.name = "cold", .emitted = glm::vec3(1, 1, 2)}};
    Lumels lumels;
    for (std::uint32_t i = 0; i <= kMaxEmitters; ++i) {
        scene.meshes.push_back({.primitives = {{.material = int(i % 2)}}});
        scene.instances.push_back({.name = "lamp " + std::to_string(i), .mesh = int(i)});
        lumels.lumels.push_back({.emission = scene.materials[i % 2].emitted, .instance = i});
    }
    const std::vector<LightSource> many = light_sources(scene, lumels);
    ASSERT_EQ(many.size(), 2u);
    EXPECT_EQ(many[0].name, "warm");
    EXPECT_EQ(many[0].instances.size(), kMaxEmitters / 2 + 1);
    lumels.lumels.pop_back();
    const std::vector<LightSource> few = light_sources(scene, lumels);
    ASSERT_EQ(few.size(), kMaxEmitters);
    EXPECT_EQ(few[3].name, "lamp 3");
    EXPECT_EQ(few[3].materials, std::vector<std::string>{"cold"});
}

TEST(Senders, AddUpToTheLightOfALumel)
{
    Lit lit;
    const SolveScene& world = lit.setting.prepared;
    const std::vector<glm::vec3>& irradiance = lit.solution->irradiance;
    double found = 0.0, solved = 0.0;
    bool sky = false, lamp = false, surface = false;
    for (std::uint32_t i = 0; i < irradiance.size(); i += 37) {
        if (world.lumels.lumels[i].flags & kLumelBuried)
            continue;
        const Senders senders = find_senders(world, irradiance, i, {.rays = 4096});
        glm::vec3 sum(0.0f);
        for (const Contributor& sender : senders.list) {
            sum += sender.light;
            sky = sky || sender.kind == Contributor::Kind::sky;
            lamp = lamp || (sender.kind == Contributor::Kind::lamp &&
                            world.scene.lights[sender.index].name == "lamp");
            surface = surface || sender.kind == Contributor::Kind::surface;
        }
        EXPECT_NEAR(luminance(sum), luminance(senders.light), 1e-4 * luminance(sum));
        found += luminance(senders.light);
        solved += luminance(irradiance[i]);
    }
    EXPECT_TRUE(sky && lamp && surface);
    EXPECT_NEAR(found / solved, 1.0, 0.03);
}

TEST(Senders, StateABoundOfTheirNoise)
{
    Lit lit;
    const SolveScene& world = lit.setting.prepared;
    const std::vector<glm::vec3>& irradiance = lit.solution->irradiance;
    constexpr std::uint32_t kSeeds = 24, kRays = 256;
    double variance = 0.0, bound = 0.0;
    for (std::uint32_t i = 0; i < irradiance.size(); i += 37) {
        double sum = 0.0, squares = 0.0;
        for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
            const Senders senders =
                find_senders(world, irradiance, i, {.rays = kRays, .seed = seed});
            const double light = luminance(senders.light);
            sum += light;
            squares += light * light;
            bound += senders.noise * senders.noise / kSeeds;
        }
        variance += (squares - sum * sum / kSeeds) / (kSeeds - 1);
    }
    // Samples are stratified, which lowers the noise, but not by ten.
    EXPECT_LT(variance, bound);
    EXPECT_GT(variance, bound / 100.0);
}

TEST(Why, HasASentenceIfRaysAndBakeDifferByMoreThanTheirErrors)
{
    EXPECT_EQ(remark_on_rays(0.50, 0.52, 0.01, 0.0), "");
    EXPECT_EQ(remark_on_rays(0.50, 0.40, 0.0, 0.1), "");
    const std::string remark = remark_on_rays(0.42, 0.02, 0.001, 0.05);
    EXPECT_EQ(remark.find("rays find 0.048 times the light of the bake, more than noise explains."),
              0u)
        << remark;
    EXPECT_EQ(remark_on_rays(0.0, 0.1, 0.001, 0.05).find("rays find light where the bake has none"),
              0u);
    EXPECT_EQ(remark_on_rays(0.0, 0.0, 0.0, 0.05), "");
}

/// A file beside the test program, gone when it ends.
struct File {
    std::string path = testing::TempDir() + "relight_test.lumelmat";
    ~File() { std::remove(path.c_str()); }

    std::string bytes() const
    {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void set(const std::string& bytes) const
    {
        std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    }
    /// The message of reading, empty if it succeeds.
    std::string complaint() const
    {
        return test::input_error_of([&] { read_relightable(path); });
    }
};

TEST(MatrixFile, ReadsBackWhatWasWritten)
{
    Lit lit;
    const Relightable& light = *lit.solution->relightable;
    const File file;
    write_relightable(file.path, light);
    const Relightable read = read_relightable(file.path);
    EXPECT_EQ(read.scene_hash, lit.setting.prepared.scene.hash);
    EXPECT_EQ(read.place, light.place);
    EXPECT_EQ(to_bytes(read.matrix), to_bytes(light.matrix));
    ASSERT_EQ(read.sources.size(), light.sources.size());
    RelightSession from_file(lit.device, file.path), session(lit.device, light);
    expect_alike(from_file.irradiance(), session.irradiance(), kHalfRounding);
}

TEST(MatrixFile, ReadsBackThePapersFormByteForByte)
{
    Lit lit({Lit::lamp()}, MatrixForm::bc1);
    const File file;
    write_relightable(file.path, *lit.solution->relightable);
    const std::string written = file.bytes();
    const Relightable read = read_relightable(file.path);
    EXPECT_EQ(to_bytes(read.matrix), to_bytes(lit.solution->relightable->matrix));
    write_relightable(file.path, read);
    EXPECT_EQ(file.bytes(), written);
}

TEST(MatrixFile, CutOrAlteredIsRefused)
{
    Lit lit;
    const File file;
    write_relightable(file.path, *lit.solution->relightable);
    const std::string whole = file.bytes();
    EXPECT_EQ(file.complaint(), "");
    for (std::size_t k = 1; k < 64; ++k) {
        file.set(whole.substr(0, whole.size() * k / 64));
        EXPECT_NE(file.complaint(), "") << k;
        std::string altered = whole;
        altered[whole.size() * k / 64] ^= char(1 << (k % 8));
        file.set(altered);
        EXPECT_NE(file.complaint(), "") << k;
    }
    for (std::size_t at = 0; at < 32; ++at) {  // the head
        std::string altered = whole;
        altered[at] ^= 4;
        file.set(altered);
        EXPECT_NE(file.complaint(), "") << at;
    }
    file.set(whole + "more");
    EXPECT_NE(file.complaint().find("damaged"), std::string::npos);
    std::string newer = whole;
    newer[8] = 3;
    file.set(newer);
    EXPECT_NE(file.complaint().find("another version"), std::string::npos);
}

// A fingerprint can be made to fit: what is indexed by a file's numbers still holds.
TEST(MatrixFile, ForgedIsRefusedOrHarmless)
{
    Lit lit;
    const File file;
    write_relightable(file.path, *lit.solution->relightable);
    const std::string whole = file.bytes();
    constexpr std::size_t kHead = 32, kFingerprintAt = 24;
    for (std::size_t k = 0; k < 200; ++k) {
        std::string forged = whole;
        const std::size_t at =
            k < 100 ? kHead + k : kHead + (whole.size() - kHead) * (k - 99) / 102;
        forged[at] = char(0xff);
        Fingerprint fingerprint;
        fingerprint.add_bytes(forged.data() + kHead, forged.size() - kHead);
        const std::uint64_t value = fingerprint.value();
        std::memcpy(forged.data() + kFingerprintAt, &value, sizeof value);
        file.set(forged);
        if (file.complaint().empty())
            RelightSession(lit.device, file.path).irradiance();
    }
}

}  // namespace
}  // namespace lumel
