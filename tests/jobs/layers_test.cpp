// What global directions see through layers of surfaces.

#include "../support/box_lumels.h"
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
