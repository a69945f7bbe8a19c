// What global directions see through layers of surfaces.

#include <cmath>

#include "../support/box_lumels.h"
#include "../support/closed_forms.h"
#include "methods/directions/directions.h"
#include "scene/sky/light_options.h"
#include "solved.h"

namespace lumel {
namespace {

Scene planes_under_white_sky()
{
    LightOptions lights;
    lights.sky_color = glm::vec3(1.0f);
    return read_scene(support::scene_path("planes"), MaterialModel::diffuse, lights);
}

/// Five red planes below a white one, below the white one on top, which can see no red.
const SolveScene& planes()
{
    static const SolveScene instance(planes_under_white_sky(), AtlasOptions{.size = 48});
    return instance;
}

std::vector<glm::vec3> gathered(const SolveScene& world, Layers layers, int lookups = 1,
                                std::uint32_t slabs = 1, LookupTest test = LookupTest::planes)
{
    const gpu::Device device;
    const World resident(device, world.scene, world.lumels, &world.atlas);
    const SolverOptions options{.method = DirectionsOptions{.iteration = {Scheme::paper},
                                                            .layers = layers,
                                                            .lookups = lookups,
                                                            .lookup_test = test,
                                                            .slabs = slabs,
                                                            .map_side = 128},
                                .max_shots = 1024,
                                .target_error = 0.0};
    const auto solver = make_solver({&device, &resident, world.lumels, {}}, options);
    EXPECT_TRUE(solve(*solver, options));
    std::vector<glm::vec3> irradiance = solver->irradiance();
    EXPECT_EQ(device.validation_messages(), "");
    return irradiance;
}

bool is_top(const Lumel& lumel)
{
    return planes().scene.instances[lumel.instance].name == "top";
}

/// How much more red than green the plane on top receives on both sides, as a part of the green.
double red_on_top(int lookups, std::uint32_t slabs = 1, LookupTest test = LookupTest::planes)
{
    const std::vector<glm::vec3> irradiance =
        gathered(planes(), Layers::stochastic, lookups, slabs, test);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        if (is_top(planes().lumels.lumels[i]))
            sum += glm::dvec3(irradiance[i]);
    return (sum.r - sum.g) / sum.g;
}

class ExactLayers : public testing::TestWithParam<Layers> {};

TEST_P(ExactLayers, LeaveThePlaneThatSeesNoRedWhite)
{
    const std::vector<glm::vec3> irradiance = gathered(planes(), GetParam());
    std::size_t count = 0;
    double below = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = planes().lumels.lumels[i];
        if (!is_top(lumel))
            continue;
        ++count;
        EXPECT_EQ(irradiance[i].r, irradiance[i].g) << "lumel " << i;
        if (lumel.flags & kLumelBack)
            below += double(irradiance[i].g);
    }
    EXPECT_GT(count, 100u);
    EXPECT_GT(below, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Are, ExactLayers, testing::Values(Layers::list, Layers::peel),
                         [](const auto& test) {
                             return std::string(test.param == Layers::list ? "Listed" : "Peeled");
                         });

TEST(Layers, PeeledAreThoseListed)
{
    EXPECT_EQ(gathered(planes(), Layers::peel), gathered(planes(), Layers::list));
}

TEST(Layers, MoreLookupsLeakLess)
{
    const double one = red_on_top(1);
    const double three = red_on_top(3);
    const double five = red_on_top(5);
    EXPECT_GT(five, 0.0);
    EXPECT_LT(five, 0.5 * three);
    EXPECT_LT(three, 0.5 * one);
}

// [TN11] Figure 8: the red that leaks, as a part of the grey.
TEST(Layers, LeakNoMoreThanThePapers)
{
    for (const LookupTest test : {LookupTest::paper, LookupTest::planes}) {
        EXPECT_LT(red_on_top(1, 1, test), 0.41);
        EXPECT_LT(red_on_top(3, 1, test), 0.08);
        EXPECT_LT(red_on_top(5, 1, test), 0.01);
    }
}

TEST(Layers, MoreSlabsLeakLess)
{
    EXPECT_LT(red_on_top(3, 2), 0.5 * red_on_top(3, 1));
    EXPECT_LT(red_on_top(1, 8), 0.1 * red_on_top(1, 1));
}

double mean_of(const Lumels& lumels, const std::vector<glm::vec3>& irradiance, std::size_t first,
               std::size_t last)
{
    double light = 0.0, area = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        light += double(lumels.lumels[i].area) * double(irradiance[i].g);
        area += double(lumels.lumels[i].area);
    }
    return light / area;
}

/// Hills of 1 m from crest to crest, on facets of half a pixel to two.
Scene ripples()
{
    constexpr int kCells = 96;
    constexpr float kLength = 4.0f;
    const auto height = [](const glm::vec2& at) {
        return 0.08f * std::sin(6.3f * at.x + 1.0f) + 0.05f * std::sin(7.1f * at.y - 2.3f * at.x) +
               0.01f * std::sin(23.0f * at.x) * std::sin(21.0f * at.y);
    };
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (int row = 0; row <= kCells; ++row)
        for (int column = 0; column <= kCells; ++column) {
            const glm::vec2 at = kLength / float(kCells) * glm::vec2(column, row);
            positions.emplace_back(at.x, height(at), at.y);
        }
    for (int row = 0; row < kCells; ++row)
        for (int column = 0; column < kCells; ++column) {
            const auto a = std::uint32_t(row * (kCells + 1) + column);
            const std::uint32_t b = a + kCells + 1;
            indices.insert(indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    Scene scene;
    support::add_mesh(scene, positions, indices, Material{});
    scene.sky = {.width = 1, .height = 1, .radiance = {glm::vec3(1.0f)}};
    return scene;
}

// Mended [TN11] Figure 5: the ground beside a point is no occluder, whichever way it curves.
TEST(Layers, OfRipplesDarkenNoHollows)
{
    const SolveScene world(ripples(), AtlasOptions{.size = 48});
    const auto mean = [&](Layers layers, LookupTest test) {
        return mean_of(world.lumels, gathered(world, layers, 3, 1, test), 0,
                       world.lumels.lumels.size());
    };
    const double truth = mean(Layers::list, LookupTest::planes);
    EXPECT_NEAR(mean(Layers::stochastic, LookupTest::planes) / truth, 1.0, 0.03);
    EXPECT_LT(mean(Layers::stochastic, LookupTest::paper) / truth, 0.8);
}

// A pixel beside it shows the ceiling nearer than the lamp; by their planes the lamp is nearer.
TEST(Layers, OfALampJustBelowTheCeilingShowTheLamp)
{
    constexpr float kGap = 0.0005f;
    constexpr Span kLamp{0.1, 0.9};
    support::Quad floor{.albedo = glm::vec3(0.0f), .res_u = 8, .res_v = 8};
    support::Quad ceiling{
        .corner = {0, 0, 1}, .edge_u = {0, 1, 0}, .edge_v = {1, 0, 0}, .albedo = glm::vec3(0.0f)};
    support::Quad lamp = ceiling;
    const auto side = float(kLamp.high - kLamp.low);
    lamp.corner = {float(kLamp.low), float(kLamp.low), 1.0f - kGap};
    lamp.edge_u *= side;
    lamp.edge_v *= side;
    lamp.emission = glm::vec3(1.0f);
    const std::vector<support::Quad> quads = {floor, ceiling, lamp};
    support::HandMade room = support::make_quads(quads);
    const Atlas atlas = support::lay_out(room, quads);
    const SolveScene world(room.scene, atlas, room.lumels);
    double truth = 0.0;
    for (std::size_t i = room.first[0]; i < room.first[1]; ++i) {
        const glm::dvec3 x(room.lumels.lumels[i].position);
        truth +=
            point_to_parallel_rectangle({kLamp.low - x.x, kLamp.high - x.x},
                                        {kLamp.low - x.y, kLamp.high - x.y}, 1.0 - double(kGap)) /
            double(room.first[1]);
    }
    const auto mean = [&](LookupTest test) {
        return mean_of(world.lumels, gathered(world, Layers::stochastic, 3, 1, test), 0,
                       room.first[1]);
    };
    EXPECT_NEAR(mean(LookupTest::planes) / truth, 1.0, 0.06);
    EXPECT_LT(mean(LookupTest::paper) / truth, 0.8);
}

/// How the solver cuts the directions of a scene.
std::uint32_t slabs_of(const SolveScene& world, int lookups)
{
    const gpu::Device device;
    const World resident(device, world.scene, world.lumels, &world.atlas);
    const GlobalDirections solver(
        device, resident, world.lumels,
        {.layers = Layers::stochastic, .lookups = lookups, .map_side = 128});
    EXPECT_EQ(device.validation_messages(), "");
    return solver.slabs();
}

TEST(Layers, AreCutAsTheirOverdrawAsksFor)
{
    EXPECT_GT(slabs_of(planes(), 1), slabs_of(planes(), 3));
    EXPECT_GT(slabs_of(planes(), 3), 1u);
    const SolveScene plane(support::make_quads({{.double_sided = true}}).scene,
                           AtlasOptions{.size = 32});
    EXPECT_EQ(slabs_of(plane, 1), 1u);
}

}  // namespace
}  // namespace lumel
