// Light is linear in its sources: each lamp's is that of a scene without the others.

#include <cmath>

#include "../support/box_lumels.h"
#include "../support/input_error.h"
#include "links/trace/links.h"
#include "solved.h"

namespace lumel {
namespace {

constexpr int kSize = 48;  // of the atlas [texels]

/// The Cornell box under a sky, with a bulb in it beside its own lamp.
Scene lit_box()
{
    Scene scene = read_scene(support::scene_path("cornell-box"), MaterialModel::diffuse,
                             {.sky_color = glm::vec3(1.0f, 2.0f, 4.0f)});
    PunctualLight bulb{.name = "bulb", .intensity = 0.1f};
    bulb.color = glm::vec3(1.0f, 0.6f, 0.2f);
    bulb.transform[3] = glm::vec4(0.45f, 0.3f, 0.1f, 1.0f);
    scene.lights = {bulb};
    return scene;
}

SolverOptions options_for(double error)
{
    SolverOptions options;
    options.method = LinksOptions{.per_lamp = true};
    options.target_error = error;
    options.target_quality = {};
    return options;
}

struct Apart {
    std::vector<glm::vec3> whole;
    std::vector<NamedLamp> lamps;
    std::vector<LinkRadiosity::LampLight> light;
};

Apart solve_apart(const SolveScene& world, const SolverOptions& options,
                  const std::vector<LampGroup>& groups = {})
{
    LinksOptions links = std::get<LinksOptions>(options.method);
    links.groups = groups;
    LinkRadiosity solver(world, links, options.limits());
    EXPECT_TRUE(solve(solver, options));
    const std::vector<glm::vec3> whole = solver.irradiance();
    auto found = solver.light_of_lamps();
    return {whole, solver.lamps()->all, std::move(found->lamps)};
}

/// Relative RMSE over open lumels.
double apart(const SolveScene& world, const std::vector<glm::vec3>& a,
             const std::vector<glm::vec3>& b)
{
    return support::lumel_error(
               world.lumels, a, b,
               [](const Lumel& lumel) { return (lumel.flags & kLumelBuried) == 0; })
        .rmse;
}

double sum_of(const std::vector<glm::vec3>& light)
{
    double sum = 0.0;
    for (const glm::vec3& one : light)
        sum += double(one.r + one.g + one.b);
    return sum;
}

void leave_only(Scene& scene, const std::string& kind)
{
    if (kind != "sky")
        scene.sky = {};
    if (kind != "point")
        scene.lights.clear();
    if (kind != "surface")
        for (Material& material : scene.materials)
            material.emitted = glm::vec3(0.0f);
}

TEST(Lamps, HaveTheLightOfASceneWithoutTheOthers)
{
    const SolveScene world(lit_box(), {.size = kSize});
    const Apart found = solve_apart(world, options_for(0.01));
    ASSERT_EQ(found.lamps.size(), 3u);
    for (std::size_t k = 0; k < found.lamps.size(); ++k) {
        Scene alone = lit_box();
        leave_only(alone, found.lamps[k].kind);
        const SolveScene dim(std::move(alone), {.size = kSize});
        const Apart wanted = solve_apart(dim, options_for(0.005));
        ASSERT_EQ(wanted.whole.size(), found.whole.size());
        const double stated = std::hypot(found.light[k].error, 0.005);
        EXPECT_LT(apart(world, found.light[k].irradiance, wanted.whole), 1.5 * stated)
            << found.lamps[k].name;
        EXPECT_GT(apart(world, found.light[k].irradiance, wanted.whole), 0.3 * stated)
            << found.lamps[k].name;
        EXPECT_NEAR(sum_of(found.light[k].irradiance) / sum_of(wanted.whole), 1.0, 0.005)
            << found.lamps[k].name;
    }
}

TEST(Lamps, AddUpToTheWholeLight)
{
    const SolveScene world(lit_box(), {.size = kSize});
    const Apart found = solve_apart(world, options_for(0.05));
    double worst = 0.0;
    for (std::size_t i = 0; i < found.whole.size(); ++i) {
        glm::vec3 sum(0.0f);
        for (const LinkRadiosity::LampLight& lamp : found.light)
            sum += lamp.irradiance[i];
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, double(std::abs(sum[c] - found.whole[i][c])) /
                                        std::max(double(found.whole[i][c]), 1e-3));
    }
    EXPECT_LT(worst, 1e-5);
}

/// Scaling them to the whole hides no light: all of it, with that of rays near their lumel and
/// behind glass, is some lamp's.
TEST(Lamps, MissNothingOfTheWholeBeforeTheyAreScaled)
{
    constexpr double kMissing = 0.01;  // more than sweeps leave out and noise of 384 rays
    Scene glazed = lit_box();
    for (Instance& instance : glazed.instances)
        if (instance.name.find("short") != std::string::npos) {
            Mesh& mesh = glazed.meshes[std::size_t(instance.mesh)];
            for (Primitive& primitive : mesh.primitives)
                glazed.materials[std::size_t(primitive.material)].transmission = 0.5f;
        }
    std::vector<Scene> scenes = {lit_box(), std::move(glazed)};
    for (const char* name : {"room", "city", "two-rooms-window"})
        scenes.push_back(read_scene(support::scene_path(name), MaterialModel::diffuse,
                                    {.sky_color = glm::vec3(1.0f, 2.0f, 4.0f)}));
    for (const Scene& scene : scenes)
        for (const auto& [filter, parts] :
             {std::pair{true, Parts::all}, {true, Parts::direct}, {false, Parts::indirect}}) {
            const SolveScene world(scene, {.size = 96});
            LinkRadiosity solver(world, LinksOptions{.filter = filter, .per_lamp = true},
                                 {.max_shots = 384}, parts);
            SolverOptions options;
            options.max_shots = 384;
            ASSERT_TRUE(solve(solver, options));
            EXPECT_NEAR(solver.light_of_lamps()->missing, 0.0, kMissing)
                << scene.path << ", parts " << int(parts) << ", filter " << filter;
        }
}

/// A bake that time ends in the middle of a round or of a pass has the light of those before.
TEST(Lamps, AreWholeWhereverASolutionEnds)
{
    const SolveScene world(lit_box(), {.size = kSize});
    for (const int steps : {1, 2, 3, 4, 6, 8, 10, 12, 15}) {
        LinkRadiosity solver(world, LinksOptions{.per_lamp = true}, {.target_error = 0.01});
        for (int step = 0; step < steps; ++step)
            solver.step();
        const std::vector<glm::vec3> whole = solver.irradiance();
        const auto found = solver.light_of_lamps();
        std::vector<glm::vec3> sum(whole.size(), glm::vec3(0.0f));
        for (const LinkRadiosity::LampLight& lamp : found->lamps)
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] += lamp.irradiance[i];
        ASSERT_GE(sum_of(whole), 0.0);
        if (sum_of(whole) == 0.0)
            continue;
        EXPECT_LT(apart(world, sum, whole), 1e-5) << steps << " steps";
        // Direct light can be refined beyond what the whole was last filtered with.
        EXPECT_NEAR(found->missing, 0.0, 0.01) << steps << " steps";
    }
}

TEST(Lamps, AreNotFoundIfTheUserStops)
{
    const SolveScene world(lit_box(), {.size = 16});
    LinkRadiosity solver(world, LinksOptions{.per_lamp = true}, {.max_shots = 24});
    SolverOptions options;
    options.max_shots = 24;
    ASSERT_TRUE(solve(solver, options));
    EXPECT_FALSE(solver.light_of_lamps([](double) { return false; }));
}

/// The whole light has the same bits whether lamps are kept apart or not.
TEST(Lamps, KeptApartChangeNothingInTheWhole)
{
    const SolveScene world(lit_box(), {.size = kSize});
    const SolverOptions options = options_for(0.03);
    const Apart found = solve_apart(world, options);
    LinkRadiosity plain(world, LinksOptions{}, options.limits());
    ASSERT_TRUE(solve(plain, options));
    EXPECT_EQ(plain.irradiance(), found.whole);
}

/// A group of all is the whole, and one of two is their sum.
TEST(Lamps, OfAGroupAreOne)
{
    const SolveScene world(lit_box(), {.size = kSize});
    const SolverOptions options = options_for(0.05);
    const Apart each = solve_apart(world, options),
                all = solve_apart(world, options, {{"all", "*"}}),
                two = solve_apart(world, options, {{"two", "bulb"}, {"two", "sky"}});
    ASSERT_EQ(all.lamps.size(), 1u);
    EXPECT_EQ(all.lamps[0].kind, "group");
    EXPECT_LT(apart(world, all.light[0].irradiance, all.whole), 1e-6);
    ASSERT_EQ(two.lamps.size(), 2u);
    EXPECT_EQ(two.lamps[0].members, (std::vector<std::string>{"sky", "bulb"}));
    std::vector<glm::vec3> sum(each.whole.size(), glm::vec3(0.0f));
    for (std::size_t k = 0; k < each.lamps.size(); ++k)
        if (each.lamps[k].kind != "surface")
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] += each.light[k].irradiance[i];
    EXPECT_LT(apart(world, two.light[0].irradiance, sum), 1e-3);
}

/// Many lamps take several sweeps of a few each. In a closed bright room every one has its share
/// of the level: that of its power.
TEST(Lamps, OfABrightClosedRoomShareItsLevelByTheirPower)
{
    constexpr float kAlbedo = 0.9f;
    Scene scene;
    scene.max_albedo = 1.0f;
    support::Quad look{.albedo = glm::vec3(kAlbedo)};
    for (const support::Quad& wall : support::box_walls({0, 0, 0}, {2.0f, 1.5f, 3.0f}, true, look))
        support::add_quad(scene, wall);
    double all = 0.0;
    for (int k = 0; k < 11; ++k) {
        PunctualLight bulb{.name = "bulb " + std::to_string(k), .intensity = float(1 + k)};
        bulb.transform[3] = glm::vec4(0.3f + 0.14f * float(k), 0.75f, 0.4f + 0.2f * float(k), 1.0f);
        all += double(bulb.intensity);
        scene.lights.push_back(bulb);
    }
    const SolveScene world(std::move(scene), {.size = kSize});
    const Apart found = solve_apart(world, options_for(0.02));
    ASSERT_EQ(found.lamps.size(), 11u);
    const double area = 2.0 * (2.0 * 1.5 + 1.5 * 3.0 + 3.0 * 2.0);
    for (std::size_t k = 0; k < found.lamps.size(); ++k) {
        double light = 0.0, lumels = 0.0;
        for (std::size_t i = 0; i < found.whole.size(); ++i) {
            const auto weight = double(world.lumels.lumels[i].area);
            light += weight * double(found.light[k].irradiance[i].g);
            lumels += weight;
        }
        // Σ A H = Φ / (1 - ρ)
        const double power = 4.0 * double(support::kPi) * double(1 + k);
        EXPECT_NEAR(light / lumels * area / (power / (1.0 - double(kAlbedo))), 1.0, 0.03) << k;
    }
}

void expect_words(const std::string& sentence, const std::vector<std::string>& words)
{
    for (const std::string& word : words)
        EXPECT_NE(sentence.find(word), std::string::npos) << sentence;
}

TEST(Lamps, ThatCannotBeKeptApartAreRefused)
{
    const SolveScene world(lit_box(), {.size = 16});
    const auto refuses = [&](const std::vector<LampGroup>& groups,
                             const std::vector<std::string>& words) {
        expect_words(test::input_error_of([&] {
                         const LinkRadiosity solver(
                             world, LinksOptions{.per_lamp = true, .groups = groups}, {});
                     }),
                     words);
    };
    refuses({{"kitchen", "lamp_k*"}}, {"lamp_k*", "bulb", "sky"});
    refuses({{"a", "bulb"}, {"b", "b*"}}, {"bulb", "\"a\"", "\"b\""});
    refuses({{"sky", "bulb"}}, {"sky"});
    Scene dark = lit_box();
    leave_only(dark, "none");
    const SolveScene night(std::move(dark), {.size = 16});
    expect_words(test::input_error_of([&] {
                     const LinkRadiosity solver(night, LinksOptions{.per_lamp = true}, {});
                 }),
                 {"cornell-box", "no lamp"});
}

}  // namespace
}  // namespace lumel
