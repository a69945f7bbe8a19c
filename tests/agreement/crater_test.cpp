// A crater in the sun, lit by every method: the shadow receives everywhere the same light, that of
// its closed form.

#include <cmath>
#include <iostream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "atlas/prepare/solve_scene.h"
#include "crater.h"
#include "jobs/bake/bake.h"
#include "jobs/edit/finished_bake.h"
#include "methods/methods.h"
#include "truth/reference.h"

namespace lumel::test {
namespace {

/// Of the atlas [texels].
constexpr int kCraterSide = 64;

constexpr std::uint64_t kDirections = 1024;
/// Of a direction's map [pixels]: facets are several pixels wide.
constexpr int kMapSide = 512;

const Crater& crater()
{
    static const Crater made;
    return made;
}

/// Against the closed form, as parts of it.
struct CraterError {
    double level = 0.0;   ///< of the shadow's mean
    double spread = 0.0;  ///< RMSE of the shadow's lumels
    double all = 0.0;     ///< of the mean light of the whole crater
};

CraterError error_of(const Lumels& lumels, const std::vector<glm::vec3>& irradiance)
{
    double area = 0.0, light = 0.0, in_shadow = 0.0, level = 0.0, square = 0.0;
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        const double h = double(irradiance[i].g), a = double(lumel.area);
        area += a;
        light += a * h;
        if (!Crater::in_shadow(lumel))
            continue;
        const double off = h / crater().reflected() - 1.0;
        in_shadow += a;
        level += a * off;
        square += a * off * off;
    }
    EXPECT_GT(in_shadow, 0.25 * area);
    EXPECT_LT(in_shadow, 0.75 * area);
    return {level / in_shadow, std::sqrt(square / in_shadow),
            light / area / (crater().mean_sunlight() + crater().reflected()) - 1.0};
}

void expect_within(const char* name, const CraterError& error, const CraterError& bound)
{
    std::cout << fmt::format("{:24} level {:+.2f} %, spread {:.2f} %, all {:+.2f} %\n", name,
                             100.0 * error.level, 100.0 * error.spread, 100.0 * error.all);
    EXPECT_LE(std::abs(error.level), bound.level);
    EXPECT_LE(error.spread, bound.spread);
    EXPECT_LE(std::abs(error.all), bound.all);
}

struct Method {
    const char* name;
    MethodOptions options;
    CraterError bound;
};

void PrintTo(const Method& method, std::ostream* out)
{
    *out << method.name;
}

/// Most of the spread is noise: bakes stop at an estimated error of 1 %, or at kDirections.
std::vector<Method> crater_methods()
{
    // Random depths widen what a pixel's neighbours show by a pixel: the rim by 1 % of the opening.
    const DirectionsOptions lists{.map_side = kMapSide};
    DirectionsOptions random_depths = lists;
    random_depths.layers = Layers::stochastic;
    return {{"links", LinksOptions{}, {0.01, 0.03, 0.005}},
            {"stochastic", StochasticOptions{}, {0.01, 0.02, 0.005}},
            {"glossy", GlossyOptions{}, {0.01, 0.02, 0.005}},
            {"directions_by_lists", lists, {0.01, 0.07, 0.005}},
            {"directions_by_random_depths", random_depths, {0.02, 0.04, 0.01}},
            {"progressive", ProgressiveOptions{}, {0.003, 0.005, 0.001}},
            {"gather", GatherOptions{.batch = 64, .hemicube = 32}, {0.01, 0.02, 0.005}},
            {"matrix", MatrixOptions{}, {0.003, 0.005, 0.001}}};
}

CraterError baked(const MethodOptions& method)
{
    BakeOptions options;
    options.atlas.size = kCraterSide;
    options.preview_width = 0;
    options.solver.method = method;
    options.solver.target_error = 0.01;
    if (std::holds_alternative<DirectionsOptions>(method))
        options.solver.max_shots = kDirections;
    const TemporaryFolder folder;
    bake(crater().path(), folder / "out", options);
    const FinishedBake done(folder / "out");
    return error_of(done.prepared.lumels, done.irradiance);
}

class CraterShadow : public testing::TestWithParam<Method> {};

INSTANTIATE_TEST_SUITE_P(By, CraterShadow, testing::ValuesIn(crater_methods()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(CraterShadow, ReceivesTheSameLightEverywhere)
{
    const Method& method = GetParam();
    expect_within(method.name, baked(method.options), method.bound);
}

// The paper's own rule takes the ground beside a point for an occluder: more than half of the light
// of the shadow is missing.
TEST(CraterShadowByThePapersRule, IsDark)
{
    const CraterError error =
        baked(DirectionsOptions{.layers = Layers::stochastic, .lookup_test = LookupTest::paper});
    EXPECT_LT(error.level, -0.5);
}

TEST(CraterShadowReference, ReceivesTheSameLightEverywhere)
{
    const SolveScene world(crater().path(), {.size = kCraterSide});
    expect_within("reference",
                  error_of(world.lumels, reference_irradiance(world.scene, world.rays, world.lumels,
                                                              {.samples_per_lumel = 4096})),
                  {0.003, 0.025, 0.001});
}

}  // namespace
}  // namespace lumel::test
