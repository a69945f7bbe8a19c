// The solver against what is known exactly.

#include "../support/box_lumels.h"
#include "../support/closed_forms.h"
#include "solved.h"

namespace lumel {
namespace {

using support::LumelError;
using support::Solved;

/// "raster" is links whose rays are drawn.
std::vector<const char*> with_raster(std::vector<const char*> methods)
{
    methods.push_back("raster");
    return methods;
}

const auto kEverySolver = testing::ValuesIn(with_raster(support::diffuse_methods()));
const auto kEveryShooter = testing::Values("stochastic", "progressive");
const auto kMethodName = [](const auto& test) { return std::string(test.param); };

/// Drawings are slow without a GPU, and so many fewer rays are enough.
constexpr std::uint64_t kFewerDrawn = 8;

MethodOptions method_named(const std::string& name)
{
    return name == "raster" ? LinksOptions{.rays = Rays::raster} : support::method(name);
}

/// What is enough of a solver that gathers where it is to meet closed forms.
struct Gathering {
    std::uint64_t bounces = 5;  ///< the first, and two pairs of opposite points
    int hemicube = 32;          ///< [pixels], multisampled
};

/// As many hemicubes as the bounces take, if the method gathers; else `shooters`.
SolverOptions with_shots(SolverOptions options, std::uint64_t shooters, const Lumels& lumels,
                         const Gathering& gathering = {})
{
    options.target_error = 0.0;
    options.max_shots = shooters;
    if (const auto* links = std::get_if<LinksOptions>(&options.method))
        if (links->rays == Rays::raster)
            options.max_shots /= kFewerDrawn;
    if (auto* gather = std::get_if<GatherOptions>(&options.method)) {
        gather->batch = 64;
        gather->hemicube = gathering.hemicube;
        options.max_shots = gathering.bounces * lumels.lumels.size();
    }
    return options;
}

/// Shots of a method that bring as little noise as that many random shooters: those of links are
/// rays of each lumel, of which fewer will do.
std::uint64_t shots_like(const std::string& method, std::uint64_t shooters)
{
    constexpr std::uint64_t kFewerRays = 8, kFewerOfDrawn = 4, kFewerBrightest = 2;
    return method == "links"         ? shooters / kFewerRays
           : method == "raster"      ? shooters / kFewerOfDrawn
           : method == "progressive" ? shooters / kFewerBrightest
                                     : shooters;
}

/// Where all light is direct: links, which would refine it as long as there are shots, end at an
/// estimated error.
SolverOptions for_direct_light(const std::string& method, std::uint64_t shooters,
                               const Lumels& lumels, const Gathering& gathering = {})
{
    constexpr double kEnough = 0.001;
    SolverOptions options =
        with_shots({.method = method_named(method)}, shooters, lumels, gathering);
    if (std::holds_alternative<LinksOptions>(options.method))
        options.target_error = kEnough;
    return options;
}

/// Area-weighted mean of B = E + ρH over all channels, and the share of lumels within
/// `tolerance` of `truth`.
struct Glow {
    double mean = 0.0, share_within = 0.0;
};

Glow furnace_glow(const std::string& name, double truth, double tolerance, SolverOptions options,
                  const std::string& method)
{
    const bool gathers = std::holds_alternative<GatherOptions>(options.method);
    const SolveScene furnace(support::scene_path(name), AtlasOptions{.size = gathers ? 32 : 40});
    // Every direction lights every lumel.
    const std::uint64_t shooters =
        method == "directions" || method == "raster" ? 2048 : shots_like(method, 16384);
    const Solved solved =
        support::solve_scene(furnace, with_shots(options, shooters, furnace.lumels, {40}));
    Glow glow;
    double area = 0.0, within = 0.0, count = 0.0;
    for (std::size_t i = 0; i < solved.irradiance.size(); ++i) {
        const Lumel& lumel = furnace.lumels.lumels[i];
        const glm::vec3 radiosity = lumel.emission + lumel.albedo * solved.irradiance[i];
        const double b = double(radiosity.r + radiosity.g + radiosity.b) / 3.0;
        glow.mean += b * double(lumel.area);
        area += double(lumel.area);
        within += std::abs(b - truth) <= tolerance * truth;
        count += 1.0;
    }
    return {glow.mean / area, within / count};
}

class Furnace : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(By, Furnace, kEverySolver, kMethodName);

TEST_P(Furnace, AlbedoOneHalfGlowsTwiceItsEmission)
{
    const Glow glow =
        furnace_glow("furnace-0.5", 2.0, 0.03, {.method = method_named(GetParam())}, GetParam());
    EXPECT_NEAR(glow.mean, 2.0, 0.005 * 2.0);
    EXPECT_GE(glow.share_within, 0.99);
}

TEST_P(Furnace, AlbedoNineTenthsGlowsTenTimesItsEmission)
{
    const Glow glow =
        furnace_glow("furnace-0.9", 10.0, 0.05, {.method = method_named(GetParam())}, GetParam());
    EXPECT_NEAR(glow.mean, 10.0, 0.01 * 10.0);
    EXPECT_GE(glow.share_within, 0.99);
}

class FurnaceOnDiscs : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(By, FurnaceOnDiscs, kEveryShooter, kMethodName);

TEST_P(FurnaceOnDiscs, GlowsAlikeThroughHemispheres)
{
    MethodOptions method = method_named(GetParam());
    ASSERT_TRUE(set_option(method, "projection", "hemisphere"));
    const Glow glow = furnace_glow("furnace-0.9", 10.0, 0.05, {.method = method}, GetParam());
    EXPECT_NEAR(glow.mean, 10.0, 0.01 * 10.0);
    EXPECT_GE(glow.share_within, 0.99);
}

support::Quad dark_plate()
{
    support::Quad plate;
    plate.albedo = glm::vec3(0.0f);
    plate.res_u = plate.res_v = 20;
    return plate;
}

/// Relative RMSE on a dark unit plate at z = 0 lit by a unit plate of emission 1.
double plate_error(const std::string& method, const support::Quad& emitter,
                   const std::function<double(double x, double y)>& form_factor)
{
    const std::vector<support::Quad> quads = {dark_plate(), emitter};
    support::HandMade plates = support::make_quads(quads);
    const Atlas atlas = support::lay_out(plates, quads);
    // Half of all directions lie behind a plate.
    const std::uint64_t shooters = method == "directions" ? 12288 : 4096;
    const Solved solved = support::solve_scene(SolveScene(plates.scene, atlas, plates.lumels),
                                               for_direct_light(method, shooters, plates.lumels));
    double square = 0.0, sum = 0.0;
    for (std::size_t i = plates.first[0]; i < plates.first[1]; ++i) {
        // A lumel is the mean over its area: average the closed form over it.
        constexpr int side = 8;
        double truth = 0.0;
        for (int k = 0; k < side * side; ++k) {
            const Piece& piece = plates.lumels.pieces[plates.lumels.lumels[i].first_piece];
            const glm::vec3 p = piece.origin +
                                (float(k % side) + 0.5f) / float(side) * piece.edge_u +
                                (float(k / side) + 0.5f) / float(side) * piece.edge_v;
            truth += form_factor(double(p.x), double(p.y)) / double(side * side);
        }
        const double d = double(solved.irradiance[i].g) - truth;
        square += d * d;
        sum += truth;
    }
    const double count = double(plates.first[1] - plates.first[0]);
    return std::sqrt(square / count) / (sum / count);
}

class Plates : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(By, Plates, kEverySolver, kMethodName);

TEST_P(Plates, FacingEachOtherMatchThePointFormFactor)
{
    support::Quad emitter = dark_plate();
    emitter.corner = {0, 0, 1};
    emitter.edge_u = {0, 1, 0};
    emitter.edge_v = {1, 0, 0};
    emitter.emission = glm::vec3(1.0f);
    EXPECT_LT(plate_error(GetParam(), emitter,
                          [](double x, double y) {
                              return point_to_parallel_rectangle({-x, 1 - x}, {-y, 1 - y}, 1.0);
                          }),
              0.01);
}

TEST_P(Plates, MeetingAtARightAngleMatchThePointFormFactor)
{
    support::Quad emitter = dark_plate();
    emitter.edge_u = {0, 0, 1};
    emitter.edge_v = {1, 0, 0};
    emitter.emission = glm::vec3(1.0f);
    EXPECT_LT(plate_error(GetParam(), emitter,
                          [](double x, double y) {
                              return point_to_perpendicular_rectangle({-x, 1 - x}, {0, 1}, y);
                          }),
              0.01);
}

class GrazingLight : public testing::TestWithParam<const char*> {};

/// Along one in 3,000 of the global directions such a floor sees the lamp: a per cent would take
/// millions of them.
std::vector<const char*> all_but_directions()
{
    std::vector<const char*> methods = with_raster(support::diffuse_methods());
    std::erase_if(methods, [](const char* name) { return std::string(name) == "directions"; });
    return methods;
}

INSTANTIATE_TEST_SUITE_P(By, GrazingLight, testing::ValuesIn(all_but_directions()), kMethodName);

// A small lamp low above a long floor, which is drawn since something lies below it.
TEST_P(GrazingLight, FromALowLampMatchesThePointFormFactor)
{
    constexpr float kLength = 3.0f, kWidth = 0.25f;
    constexpr Span kLamp{0.03, 0.07};
    support::Quad floor;
    floor.albedo = glm::vec3(0.0f);
    floor.edge_u = {kWidth, 0, 0};
    floor.edge_v = {0, kLength, 0};
    floor.res_u = 10;
    floor.res_v = 120;
    support::Quad below = floor;
    below.corner.z = -0.5f;
    below.res_u = below.res_v = 1;
    support::Quad lamp;
    lamp.albedo = glm::vec3(0.0f);
    lamp.emission = glm::vec3(1.0f);
    lamp.corner = {0, 0, float(kLamp.low)};
    lamp.edge_u = {0, 0, float(kLamp.high - kLamp.low)};
    lamp.edge_v = {kWidth, 0, 0};
    lamp.res_v = 6;
    const std::vector<support::Quad> quads = {floor, below, lamp};
    support::HandMade place = support::make_quads(quads);
    const Atlas atlas = support::lay_out(place, quads);
    const Solved solved =
        support::solve_scene(SolveScene(place.scene, atlas, place.lumels),
                             for_direct_light(GetParam(), 4096, place.lumels, {3, 96}));
    double arrived[3] = {}, truth[3] = {};  // by metre of distance
    for (std::size_t i = place.first[0]; i < place.first[1]; ++i) {
        const glm::vec3 x = place.lumels.lumels[i].position;
        const std::size_t metre = std::min(std::size_t(x.y), std::size_t(2));
        arrived[metre] += double(solved.irradiance[i].g);
        truth[metre] += point_to_perpendicular_rectangle({-double(x.x), double(kWidth - x.x)},
                                                         kLamp, double(x.y));
    }
    for (std::size_t metre = 1; metre < 3; ++metre)  // cosines below 0.07
        EXPECT_NEAR(arrived[metre] / truth[metre], 1.0, 0.01) << "from metre " << metre;
}

using Seen = std::tuple<const char*, Projection>;

class SealedBox : public testing::TestWithParam<Seen> {};

TEST_P(SealedBox, StaysExactlyDarkInside)
{
    const auto& [method, projection] = GetParam();
    const bool gathers = std::string(method) == "gather";
    const SolveScene world(support::scene_path("sealed-box"),
                           AtlasOptions{.size = gathers ? 64 : 128});
    MethodOptions options = method_named(method);
    if (projection == Projection::hemisphere) {
        ASSERT_TRUE(set_option(options, "projection", "hemisphere"));
    }
    // Every direction lights every lumel.
    const std::uint64_t shots = std::string(method) == "directions" ? 512 : 1024;
    const Solved solved =
        support::solve_scene(world, with_shots({.method = options}, shots, world.lumels, {9}));
    std::size_t inside = 0;
    float brightest = 0.0f;
    for (std::size_t i = 0; i < solved.irradiance.size(); ++i) {
        const glm::vec3 h = solved.irradiance[i];
        if (world.scene.instances[world.lumels.lumels[i].instance].name == "box inside") {
            const glm::vec3 p = world.lumels.lumels[i].position;
            ++inside;
            EXPECT_EQ(h, glm::vec3(0.0f))
                << "lumel " << i << " at " << p.x << ' ' << p.y << ' ' << p.z;
        }
        brightest = std::max(brightest, h.g);
    }
    EXPECT_GT(inside, 100u);
    EXPECT_GT(brightest, 1.0f);
}

std::string seen_name(const testing::TestParamInfo<Seen>& test)
{
    const auto& [method, projection] = test.param;
    return std::string(method) + (projection == Projection::hemicube ? "Hemicubes" : "Hemispheres");
}

INSTANTIATE_TEST_SUITE_P(By, SealedBox,
                         testing::Combine(kEveryShooter, testing::Values(Projection::hemicube,
                                                                         Projection::hemisphere)),
                         seen_name);

INSTANTIATE_TEST_SUITE_P(ByHemicubes, SealedBox,
                         testing::Values(Seen{"gather", Projection::hemicube},
                                         Seen{"matrix", Projection::hemicube},
                                         Seen{"directions", Projection::hemicube},
                                         Seen{"links", Projection::hemicube},
                                         Seen{"raster", Projection::hemicube}),
                         seen_name);

class PatchworkSphere : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(By, PatchworkSphere, kEverySolver, kMethodName);

// Every point inside a sphere sees every other alike, so B_j = E_j + ρ_j ⟨E⟩ / (1 - ⟨ρ⟩) for any
// pattern of emission and albedo: swapped indices cannot hide. A faceted ball comes close.
TEST_P(PatchworkSphere, LightsAllPatchesAlike)
{
    constexpr int rings = 24, around = 48;
    const auto point = [](int ring, int step) {
        const float theta = support::kPi * float(ring) / rings;
        const float phi = 2.0f * support::kPi * float(step) / around;
        return glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                         std::sin(theta) * std::sin(phi));
    };
    std::vector<support::Quad> quads;
    double area = 0.0, emission = 0.0, albedo = 0.0;
    for (int ring = 2; ring < rings - 2; ++ring)
        for (int step = 0; step < around; ++step) {
            const glm::vec3 a = point(ring, step), b = point(ring, step + 1),
                            c = point(ring + 1, step);
            support::Quad quad;
            quad.corner = a;
            quad.edge_u = b - a;
            quad.edge_v = c - a;
            if (glm::dot(glm::cross(quad.edge_u, quad.edge_v), a) > 0.0f)
                std::swap(quad.edge_u, quad.edge_v);
            quad.albedo = glm::vec3((step % 3 == 0) ? 0.8f : 0.2f);
            quad.emission = glm::vec3((ring + step) % 5 == 0 ? 2.0f : 0.0f);
            const double size = double(glm::length(glm::cross(quad.edge_u, quad.edge_v)));
            area += size;
            emission += size * double(quad.emission.g);
            albedo += size * double(quad.albedo.g);
            quads.push_back(quad);
        }
    support::HandMade sphere = support::make_quads(quads);
    const Atlas atlas = support::lay_out(sphere, quads);
    const bool by_directions = GetParam() == std::string("directions");
    const Solved solved = support::solve_scene(
        SolveScene(sphere.scene, atlas, sphere.lumels),
        with_shots({.method = method_named(GetParam())},
                   by_directions ? 2048 : shots_like(GetParam(), 4096), sphere.lumels));
    double by_albedo[2] = {}, by_emission[2] = {}, counts[4] = {};
    for (std::size_t i = 0; i < quads.size(); ++i) {
        const bool bright = quads[i].albedo.g > 0.5f, emits = quads[i].emission.g > 0.0f;
        by_albedo[bright] += double(solved.irradiance[i].g);
        by_emission[emits] += double(solved.irradiance[i].g);
        counts[bright] += 1.0;
        counts[2 + emits] += 1.0;
    }
    // The level itself is some per cent low, since light is lost through the gaps between flat
    // quads; that it is one level for all patches is what counts here.
    const double common = by_albedo[0] / counts[0];
    EXPECT_NEAR(by_albedo[1] / counts[1], common, 0.02 * common);
    EXPECT_NEAR(by_emission[0] / counts[2], by_emission[1] / counts[3], 0.02 * common);
    EXPECT_GT(common, 0.8 * (emission / area) / (1.0 - albedo / area));
}

}  // namespace
}  // namespace lumel
