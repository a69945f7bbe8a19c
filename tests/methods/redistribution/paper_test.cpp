// Redistribution as the thesis has it [Hoef13].

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "../../support/source_folder.h"
#include "methods/gather/gather.h"
#include "methods/redistribution/lamp_shadows.h"
#include "methods/redistribution/live_scene.h"
#include "moved_box.h"
#include "scene/values/scene.h"

namespace lumel {
namespace {

using test::shifted, test::turned_box;

constexpr int kSide = 32;  // of the atlas [texels]
constexpr int kHemicube = 64;

Scene thesis_room(const char* lamp)
{
    return read_gltf(support::source_path("scenes/moving-" + std::string(lamp) + "-lamp.gltf"));
}

LiveOptions options_of(const Scene& scene, Redistribution redistribution, int side = kSide)
{
    LiveOptions options;
    options.redistribution = redistribution;
    options.atlas.size = side;
    options.solver.views.hemicube = kHemicube;
    options.movers = {find_instance(scene, "box")};
    return options;
}

/// Relative RMSE over static lumels that are not buried.
double apart(const LiveScene& scene, const std::vector<glm::vec3>& values,
             const std::vector<glm::vec3>& truth)
{
    return test::apart(scene, values, truth, kLumelBuried | kLumelMoving);
}

/// H after the move to `place`, in a solution that had the box elsewhere.
std::vector<glm::vec3> after_move(LiveScene& live, const glm::mat4& place)
{
    live.settle();
    live.move(find_instance(live.scene(), "box"), place);
    live.settle();
    return live.irradiance();
}

/// H of a new incremental solution with the box at `place`, for lumels laid out as in `like`.
std::vector<glm::vec3> solved_at(const gpu::Device& device, const Scene& scene, LiveOptions options,
                                 const glm::mat4& place)
{
    options.redistribution = Redistribution::incremental;
    LiveScene fresh(device, scene, options);
    fresh.move(options.movers[0], place);
    fresh.settle();
    return fresh.irradiance();
}

/// H after six moves and one back to the first position.
std::vector<glm::vec3> there_and_back(LiveScene& live)
{
    constexpr int kMoves = 6;
    const std::uint32_t box = find_instance(live.scene(), "box");
    const Scene scene = live.scene();
    for (int move = 1; move <= kMoves; ++move) {
        live.move(box, shifted(scene, 0.02f * float(move), 0.1f * float(move)));
        live.settle();
    }
    return after_move(live, scene.instances[box].transform);
}

/// A device whose validation layers must find nothing.
class PaperRedistribution : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(device.validation_messages(), ""); }

    const gpu::Device device;
};

class PaperCrosses : public testing::TestWithParam<Redistribution> {
protected:
    void TearDown() override { EXPECT_EQ(device.validation_messages(), ""); }

    const gpu::Device device;
};

INSTANTIATE_TEST_SUITE_P(By, PaperCrosses,
                         testing::Values(Redistribution::paper_cross,
                                         Redistribution::paper_cross_incremental),
                         [](const auto& test) {
                             return test.param == Redistribution::paper_cross ? "whole"
                                                                              : "incremental";
                         });

// All surfaces emit E and reflect ρ: B = E + ρ B everywhere, wherever the box stands. It sends what
// it occludes, so B_j = P in Eq. (3.3.1).
TEST_P(PaperCrosses, AFurnaceStaysEvenWhereverTheBoxIs)
{
    Scene scene = thesis_room("large");
    constexpr float kAlbedo = 0.5f;
    for (Material& material : scene.materials) {
        material.base_color = glm::vec4(kAlbedo, kAlbedo, kAlbedo, 1.0f);
        material.emitted = glm::vec3(1.0f);
    }
    LiveScene live(device, scene, options_of(scene, GetParam()));
    const auto h = after_move(live, shifted(scene, 0.2f, 0.5f));
    double sum = 0.0, square = 0.0, count = 0.0, on_box = 0.0, of_box = 0.0;
    for (std::size_t i = 0; i < h.size(); ++i) {
        const Lumel& lumel = live.lumels().lumels[i];
        if (lumel.flags & kLumelBuried)
            continue;
        const double ratio = double(h[i].g / (lumel.emission.g / (1.0f - lumel.albedo.g)));
        sum += ratio;
        square += (ratio - 1.0) * (ratio - 1.0);
        count += 1.0;
        if (lumel.flags & kLumelMoving) {
            on_box += ratio;
            of_box += 1.0;
        }
    }
    EXPECT_NEAR(sum / count, 1.0, 0.01);
    EXPECT_NEAR(on_box / of_box, 1.0, 0.01);
    EXPECT_LE(std::sqrt(square / count), 0.03);
}

/// The room with one wall as its only lamp: smooth on the hemicubes, so that rays sample it well.
Scene room_with_a_wall_of_light()
{
    Scene scene = thesis_room("large");
    for (Material& material : scene.materials)
        material.emitted = glm::vec3(0.0f);
    scene.materials.push_back(scene.materials.front());
    scene.materials.back().emitted = glm::vec3(1.0f);
    const Instance& wall = scene.instances[find_instance(scene, "wall -z")];
    for (Primitive& primitive : scene.meshes[std::size_t(wall.mesh)].primitives)
        primitive.material = int(scene.materials.size()) - 1;
    return scene;
}

TEST_P(PaperCrosses, InSmoothLightAMovedBoxIsLitAsIfItAlwaysStoodThere)
{
    const Scene scene = room_with_a_wall_of_light();
    const glm::mat4 place = shifted(scene, 0.2f, 0.5f);
    constexpr int kFineSide = 64;
    const LiveOptions options = options_of(scene, GetParam(), kFineSide);
    LiveScene live(device, scene, options);
    live.settle();
    const auto before = live.irradiance();
    const auto truth = solved_at(device, scene, options, place);
    const auto h = after_move(live, place);
    EXPECT_LE(apart(live, h, truth), 0.25 * apart(live, before, truth));
}

// B^s is crossed anew where it has changed: nothing accumulates (4.5.2, Error analysis).
TEST_F(PaperRedistribution, WholeCrossProjectionForgetsPastMoves)
{
    const Scene scene = thesis_room("large");
    LiveScene live(device, scene, options_of(scene, Redistribution::paper_cross));
    live.settle();
    const auto before = live.irradiance();
    EXPECT_LE(apart(live, there_and_back(live), before), 0.001);
}

// Figure 4.5.4.
TEST_F(PaperRedistribution, IncrementalCrossProjectionAccumulatesErrors)
{
    const Scene scene = thesis_room("large");
    LiveScene live(device, scene, options_of(scene, Redistribution::paper_cross_incremental));
    live.settle();
    const auto before = live.irradiance();
    const double few = apart(live, there_and_back(live), before);
    EXPECT_GT(few, 0.01);
    EXPECT_GT(apart(live, there_and_back(live), before), 1.5 * few);
}

TEST_P(PaperCrosses, ABoxTakenOutAndPutBackIsLitAsBefore)
{
    const Scene scene = thesis_room("large");
    LiveScene live(device, scene, options_of(scene, GetParam()));
    live.settle();
    const auto before = live.irradiance();
    const glm::mat4 home = live.scene().instances[find_instance(scene, "box")].transform;
    const auto without =
        after_move(live, glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 1000.0f, 0.0f)) * home);
    EXPECT_GT(apart(live, without, before), 0.05);
    EXPECT_LE(apart(live, after_move(live, home), before), 0.0005);
}

// Figures 5.2.1 and 5.2.2: lamps are crossed through 16 rays a patch.
TEST_F(PaperRedistribution, SmallLampsAreUndersampledUnlessTheyCastShadows)
{
    const Scene scene = thesis_room("small");
    const glm::mat4 place = shifted(scene, 0.2f, 0.5f);
    LiveScene paper(device, scene, options_of(scene, Redistribution::paper_cross));
    LiveScene cross(device, scene, options_of(scene, Redistribution::cross));
    const auto truth = solved_at(device, scene, options_of(scene, Redistribution::cross), place);
    EXPECT_GT(apart(paper, after_move(paper, place), truth),
              10.0 * apart(cross, after_move(cross, place), truth));
}

/// [bytes] of stored visibility; 0: the thesis' two hemicubes a patch.
class PaperIncrementals : public testing::TestWithParam<std::uint64_t> {
protected:
    void TearDown() override { EXPECT_EQ(device.validation_messages(), ""); }

    const gpu::Device device;
};

INSTANTIATE_TEST_SUITE_P(With, PaperIncrementals,
                         testing::Values(LiveOptions{}.visibility_bytes, std::uint64_t(0)),
                         [](const auto& test) {
                             return test.param > 0 ? "stored_visibility" : "two_hemicubes";
                         });

TEST_P(PaperIncrementals, AMovedBoxIsLitAsIfItAlwaysStoodThere)
{
    const Scene scene = thesis_room("large");
    const glm::mat4 place = shifted(scene, 0.2f, 0.5f);
    LiveOptions options = options_of(scene, Redistribution::paper_incremental);
    options.visibility_bytes = GetParam();
    LiveScene live(device, scene, options);
    live.settle();
    const auto before = live.irradiance();
    const auto truth = solved_at(device, scene, options, place);
    EXPECT_GT(apart(live, before, truth), 0.05);
    EXPECT_LE(apart(live, after_move(live, place), truth), 0.002);
    const glm::mat4 home = scene.instances[options.movers[0]].transform;
    EXPECT_LE(apart(live, after_move(live, home), before), 0.001);
}

// Eq. (4.4.1): the pass that redistributes also shoots what an unfinished solution has left. The
// box is black: its own light would be left for later.
TEST_F(PaperRedistribution, AMergedPassShootsUnshotLightToo)
{
    Scene scene = thesis_room("large");
    scene.materials.emplace_back().base_color = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    const std::uint32_t box = find_instance(scene, "box");
    for (Primitive& primitive : scene.meshes[std::size_t(scene.instances[box].mesh)].primitives)
        primitive.material = int(scene.materials.size()) - 1;
    const glm::mat4 place = shifted(scene, 0.001f, 0.0f);
    const auto truth =
        solved_at(device, scene, options_of(scene, Redistribution::incremental), place);
    std::vector<double> residuals, errors;
    for (const Redistribution by :
         {Redistribution::incremental, Redistribution::paper_incremental}) {
        LiveOptions options = options_of(scene, by);
        options.residual = 0.1;
        LiveScene live(device, scene, options);
        live.settle();
        live.move(box, place);
        while (live.update(0.0).under_way) {
        }
        residuals.push_back(live.state().residual);
        errors.push_back(apart(live, live.irradiance(), truth));
    }
    EXPECT_LT(residuals[1], 0.6 * residuals[0]);
    EXPECT_LT(errors[1], 0.4 * errors[0]);  // close pairs alone bring 0.5
}

// The lamp hangs 5 mm below the ceiling and hides parts of lumels from the box: their V is that of
// receiving points, as in a solution from scratch. By their centres they would be 2.0 % off.
TEST_F(PaperRedistribution, LumelsPartlyBehindALampReceiveFromTheBoxAsInANewSolution)
{
    constexpr int kFine = 2 * kSide;
    const Scene scene = thesis_room("small");
    const glm::mat4 place = shifted(scene, 0.05f, 0.5f);
    LiveScene live(device, scene, options_of(scene, Redistribution::cross, kFine));
    const std::vector<glm::vec3> found = after_move(live, place);
    const std::vector<glm::vec3> wanted =
        solved_at(device, scene, options_of(scene, Redistribution::incremental, kFine), place);
    const std::uint32_t ceiling = find_instance(scene, "wall +y");
    double square = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Lumel& lumel = live.lumels().lumels[i];
        if (lumel.instance != ceiling || (lumel.flags & kLumelBuried) != 0u)
            continue;
        const glm::vec3 off = found[i] - wanted[i];
        square += double(glm::dot(off, off)) / 3.0;
        sum += double(wanted[i].r + wanted[i].g + wanted[i].b) / 3.0;
        count += 1.0;
    }
    EXPECT_LT(std::sqrt(square / count) / (sum / count), 0.01);
}

// Where nothing reflects, all light is of lamps: R(C, C) with V of the same points and views is
// exactly that of a new solution.
TEST_F(PaperRedistribution, LampsThatShootFromTheSolutionsPointsCastTheSameShadows)
{
    constexpr int kFine = 2 * kSide;
    const Scene scene = thesis_room("large");
    const glm::mat4 place = shifted(scene, 0.05f, 0.5f);
    const auto settled = [&](LiveOptions options, const glm::mat4& to) {
        LiveScene live(device, scene, options);
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            live.set_reflectance(i, glm::vec3(0.0f));
        return after_move(live, to);
    };
    const std::vector<glm::vec3> wanted =
        settled(options_of(scene, Redistribution::incremental, kFine), place);
    LiveOptions options = options_of(scene, Redistribution::cross, kFine);
    const LiveScene laid_out(device, scene, options);
    options.cross.lamp_points = 64;  // of 1024
    EXPECT_GT(apart(laid_out, settled(options, place), wanted), 0.003);
    options.cross.lamp_points = std::numeric_limits<std::uint32_t>::max();
    EXPECT_LT(apart(laid_out, settled(options, place), wanted), 1e-4);
}

// [Hoef13] figure 4.5.3
TEST_F(PaperRedistribution, ReprojectionBringsCrossedLightNearerToANewSolution)
{
    const Scene scene = room_with_a_wall_of_light();
    const glm::mat4 place = shifted(scene, 0.2f, 0.5f);
    const std::vector<glm::vec3> wanted =
        solved_at(device, scene, options_of(scene, Redistribution::incremental), place);
    double errors[2];
    for (const bool reprojects : {false, true}) {
        LiveOptions options = options_of(scene, Redistribution::paper_cross);
        options.reprojects = reprojects;
        LiveScene live(device, scene, options);
        errors[reprojects ? 1 : 0] = apart(live, after_move(live, place), wanted);
    }
    EXPECT_LT(errors[1], 0.8 * errors[0]) << errors[0] << ' ' << errors[1];
}

/// A scene of section 5.1, and what follows a move in it.
struct Followed {
    Redistribution redistribution;
    const char* name;
    const char* scene;
    std::uint32_t shooters;
    double residual;
};

class FollowedMove : public testing::TestWithParam<Followed> {
protected:
    void TearDown() override { EXPECT_EQ(device.validation_messages(), ""); }

    const gpu::Device device;
};

std::vector<Followed> all_followed()
{
    constexpr std::uint32_t kShooters = ProgressiveOptions{}.shooters;
    const double residual = LiveOptions{}.residual;
    std::vector<Followed> all;
    for (const Redistribution by : {Redistribution::incremental, Redistribution::cross}) {
        // The box of the indirect scene changes 0.2 % of the light.
        all.push_back({by, "indirect", "moving-indirect", kShooters, 0.2 * residual});
        all.push_back({by, "large_lamp", "moving-large-lamp", kShooters, residual});
        all.push_back({by, "small_lamp", "moving-small-lamp", kShooters, residual});
        all.push_back({by, "low_quality", "moving-large-lamp", kShooters / 8, residual});
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(By, FollowedMove, testing::ValuesIn(all_followed()), [](const auto& test) {
    return (test.param.redistribution == Redistribution::cross ? "cross_" : "incremental_") +
           std::string(test.param.name);
});

// Light of the old place that stays, or of the new one that is missing, is a share of the change.
TEST_P(FollowedMove, LeavesATenthOfItsChangeAtMost)
{
    const Scene scene =
        read_gltf(support::source_path("scenes/" + std::string(GetParam().scene) + ".gltf"));
    LiveOptions options = options_of(scene, GetParam().redistribution);
    options.solver.shooters = GetParam().shooters;
    options.residual = GetParam().residual;
    const glm::mat4 place = turned_box(scene, glm::radians(10.0f));
    LiveScene live(device, scene, options), fresh(device, scene, options);
    live.settle();
    const auto before = live.irradiance();
    const auto after = after_move(live, place);
    fresh.move(options.movers[0], place);
    fresh.settle();
    const auto wanted = fresh.irradiance();
    const auto whole = [&](const auto& h) { return test::apart(live, h, wanted); };
    EXPECT_LT(whole(after), 0.1 * whole(before)) << whole(after) << " of " << whole(before);
}

/// `values` far from walls and box, whose near field has the seed too; elsewhere `others`.
std::vector<glm::vec3> in_the_middle_of_the_floor(const LiveScene& live,
                                                  std::vector<glm::vec3> values,
                                                  const std::vector<glm::vec3>& others)
{
    const std::uint32_t floor = find_instance(live.scene(), "wall -y");
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Lumel& lumel = live.lumels().lumels[i];
        const glm::vec3 from_middle = glm::abs(lumel.position - glm::vec3(1.0f, 0.0f, 1.0f));
        if (lumel.instance != floor || std::max(from_middle.x, from_middle.z) > 0.6f)
            values[i] = others[i];
    }
    return values;
}

// Why no other solution says how much is left: one that receives at other points is further away
// than a tenth of the change.
TEST_F(PaperRedistribution, SolutionsOfTwoSeedsAreFurtherApartThanATenthOfAMove)
{
    const Scene scene = thesis_room("large");
    LiveOptions options = options_of(scene, Redistribution::incremental);
    const glm::mat4 place = turned_box(scene, glm::radians(10.0f));
    LiveScene first(device, scene, options);
    first.settle();
    ++options.solver.seed;
    LiveScene other(device, scene, options);
    other.settle();
    const auto seen = first.irradiance();
    const double change = apart(first, after_move(first, place), seen);
    const auto home = other.irradiance();
    EXPECT_GT(apart(first, in_the_middle_of_the_floor(first, home, seen), seen), 0.1 * change);
    EXPECT_LT(apart(first, home, seen), 0.05);
    // Light is taken back at the points that received it, of any seed.
    after_move(other, place);
    EXPECT_LT(apart(other, after_move(other, scene.instances[options.movers[0]].transform), home),
              0.001);
}

// A lamp of h × h at distance a above an object and b above the farthest surface blurs the edge of
// a shadow over h (b - a) / a.
TEST(LampPoints, BlurTheShadowOfEachPartOfTheLampOverHalfALumelAtMost)
{
    constexpr float kHeight = 4.0f, kReach = 1.0f;
    constexpr double kLumel = 0.1, kMost = 64.0;
    const Box world{glm::vec3(0.0f), glm::vec3(0.0f, kHeight, 0.0f)};
    const std::vector<MovedBox> boxes{{glm::vec3(0.0f), glm::vec3(0.0f, kHeight - kReach, 0.0f)}};
    const auto points = [&](float width) {
        Lumel lamp{};
        lamp.position = glm::vec3(0.0f, kHeight, 0.0f);
        lamp.area = width * width;
        return lamp_points(std::span(&lamp, 1), boxes, world, kLumel, kMost);
    };
    EXPECT_EQ(points(0.01f), 1.0);
    const double wide = points(0.1f);  // between the limits: 36
    EXPECT_NEAR(0.1 / std::sqrt(wide) * double(kHeight - kReach) / double(kReach), 0.5 * kLumel,
                1e-5);
    EXPECT_EQ(points(1.0f), kMost);
}

// Low quality: patches that send more light each.
TEST_F(PaperRedistribution, FewerShootersTakeFewerHemicubesForAboutTheSameLight)
{
    const Scene scene = thesis_room("large");
    std::vector<std::vector<glm::vec3>> light;
    std::vector<std::uint64_t> hemicubes;
    for (const std::uint32_t shooters : {512u, 32u}) {
        LiveOptions options = options_of(scene, Redistribution::incremental);
        options.solver.shooters = shooters;
        LiveScene live(device, scene, options);
        live.settle();
        light.push_back(live.irradiance());
        hemicubes.push_back(live.state().hemicubes);
        EXPECT_LT(apart(live, light.back(), light.front()), 0.1);
    }
    EXPECT_LT(2 * hemicubes[1], hemicubes[0]);
}

// Section 4.2: the mean of a mipmap chain is the sum over the hemicube.
TEST_F(PaperRedistribution, MipmapsOfHemicubesIntegrateToTheirSum)
{
    const Scene scene = thesis_room("large");
    const LiveScene laid_out(device, scene, options_of(scene, Redistribution::incremental));
    const World world(device, scene, laid_out.lumels(), &laid_out.atlas());
    std::vector<std::vector<glm::vec3>> light;
    for (const Integration integration : {Integration::sum, Integration::mipmap}) {
        GatherRadiosity solver(device, world, laid_out.lumels(),
                               {.batch = 48, .hemicube = kHemicube / 2, .integration = integration},
                               0.0);
        constexpr int kSteps = 20;  // two bounces
        for (int step = 0; step < kSteps; ++step)
            solver.step();
        light.push_back(solver.irradiance());
    }
    EXPECT_GT(light[0][0].g, 0.0f);
    EXPECT_LT(apart(laid_out, light[1], light[0]), 1e-6);
}

}  // namespace
}  // namespace lumel
