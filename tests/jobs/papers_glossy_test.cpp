// The iteration of [BSS05] as published: one average of all iterations, merged shooters, two
// choices of shooter.

#include <array>
#include <cmath>
#include <map>

#include "../support/box_lumels.h"
#include "atlas/near/world_lumels.h"
#include "jobs/render/render.h"
#include "methods/glossy/glossy.h"
#include "solved.h"

namespace lumel {
namespace {

GlossyOptions papers(std::uint32_t seed = 1)
{
    GlossyOptions options;
    options.seed = seed;
    options.scheme = Scheme::paper;
    return options;
}

TEST(PapersGlossyIteration, AveragesAllIterationsAlike)
{
    const SolveScene world(
        read_gltf(support::scene_path("glossy-cornell-box"), MaterialModel::glossy),
        AtlasOptions{.size = 32});
    GlossyOptions options = papers();
    options.views.batch = 1;
    const support::Resident resident(world.scene, world.rays, world.lumels, {.method = options});
    GlossyIllumination solver(resident.device, resident.world, world.lumels, resident.near,
                              options);
    std::vector<glm::vec3> sum(world.lumels.lumels.size(), glm::vec3(0.0f));
    double largest = 0.0;
    for (int m = 1; m <= 40; ++m) {
        solver.step();
        const std::vector<glm::vec3> mean = solver.irradiance();
        for (std::size_t i = 0; i < mean.size(); ++i) {
            const glm::vec3 now = float(m) * mean[i];
            largest = std::max(largest, double(now.g));
            // An iteration adds light and takes none away; rounding is to a part of the sum.
            ASSERT_GE(now.g, sum[i].g * (1.0f - 1e-5f)) << "iteration " << m;
            sum[i] = now;
        }
    }
    EXPECT_GT(largest, 0.0);
    EXPECT_EQ(resident.device.validation_messages(), "");
}

/// The furnace, whose walls emit 1 lm/m², of one material.
struct Furnace : SolveScene {
    explicit Furnace(const Gloss& material)
        : SolveScene(support::scene_path("furnace-0.5"), AtlasOptions{.size = 64})
    {
        for (Gloss& gloss : lumels.gloss)
            gloss = material;
    }
};

/// What shoots as one.
struct Square {
    glm::vec3 centre{0.0f}, normal{0.0f};
    float area = 0.0f;
    std::vector<std::size_t> lumels;
};

std::vector<Square> squares_of(const SolveScene& world, std::uint32_t merge)
{
    const WorldLumels standing(world.scene, world.rays, world.lumels);
    std::map<std::array<std::uint32_t, 3>, Square> squares;
    for (std::size_t i = 0; i < standing.size(); ++i) {
        const Lumel& lumel = world.lumels.lumels[i];
        const auto width = std::uint32_t(world.lumels.width);
        Square& square =
            squares[{lumel.chart, (lumel.texel % width) >> merge, (lumel.texel / width) >> merge}];
        square.centre += lumel.area * standing[i].centre;
        square.normal = standing[i].normal;
        square.area += lumel.area;
        square.lumels.push_back(i);
    }
    std::vector<Square> list;
    for (auto& [key, square] : squares) {
        square.centre /= square.area;
        list.push_back(square);
    }
    return list;
}

/// H [N] by Eq. (2) with (8), all shooters and no chance, in a box that hides nothing.
std::vector<double> summed(const SolveScene& world, std::uint32_t merge, double albedo)
{
    const WorldLumels standing(world.scene, world.rays, world.lumels);
    const std::vector<Square> squares = squares_of(world, merge);
    std::vector<double> irradiance(standing.size(), 0.0);
    constexpr int kReflections = 12;  // leave 0.5^12 of the light
    for (int reflection = 0; reflection <= kReflections; ++reflection) {
        std::vector<double> next(standing.size(), 0.0);
        for (const Square& square : squares) {
            double power = 0.0;
            for (const std::size_t m : square.lumels)
                power += double(world.lumels.lumels[m].area) * (1.0 + albedo * irradiance[m]);
            for (std::size_t i = 0; i < next.size(); ++i) {
                const glm::dvec3 d(standing[i].centre - square.centre);
                const double toward_j = glm::dot(d, glm::dvec3(square.normal)),
                             toward_i = -glm::dot(d, glm::dvec3(standing[i].normal));
                const double r2 = glm::dot(d, d);
                if (toward_j > 1e-6 && toward_i > 1e-6)
                    next[i] += power / support::kPi * toward_i * toward_j /
                               (r2 * (r2 + double(square.area) / support::kPi));
            }
        }
        irradiance = next;
    }
    return irradiance;
}

struct PapersChoice {
    std::uint32_t merge;
    bool two_choices;
};

std::ostream& operator<<(std::ostream& out, const PapersChoice& choice)
{
    return out << "squares of " << (1u << choice.merge)
               << (choice.two_choices ? ", two choices" : ", by power");
}

GlossyOptions papers(const PapersChoice& choice)
{
    GlossyOptions options = papers();
    options.merge = choice.merge;
    options.two_choices = choice.two_choices;
    return options;
}

class PapersShooters : public testing::TestWithParam<PapersChoice> {};

INSTANTIATE_TEST_SUITE_P(Choices, PapersShooters,
                         testing::Values(PapersChoice{0, false}, PapersChoice{0, true},
                                         PapersChoice{1, false}, PapersChoice{1, true},
                                         PapersChoice{2, true}));

TEST_P(PapersShooters, BringWhatTheEquationSumsUp)
{
    const Furnace furnace({glm::vec3(0.5f), glm::vec3(0.0f), 1.0f});
    GlossyOptions own = papers(GetParam());
    own.rule = SampleRule::centre;
    const support::Solved solved =
        support::solve_scene(furnace, {.method = own, .max_shots = 8192, .target_error = 0.0});
    const std::vector<double> expected = summed(furnace, own.merge, 0.5);
    double found = 0.0, sum = 0.0, square = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        found += double(solved.irradiance[i].g);
        sum += expected[i];
        square += std::pow(double(solved.irradiance[i].g) - expected[i], 2.0);
    }
    const double n = double(expected.size());
    RecordProperty("rmse", std::to_string(std::sqrt(square / n) / (sum / n)));
    EXPECT_NEAR(found, sum, 0.01 * sum);
}

class PapersClosedRoom : public testing::TestWithParam<Gloss> {};

// Eq. (8) takes light from what is close, in proportion to the side of a shooter: twice the light
// of single texels less that of squares of 2 is all that is emitted.
TEST_P(PapersClosedRoom, LosesLightInProportionToTheSideOfItsShooters)
{
    const Furnace furnace(GetParam());
    const auto absorbed = [&](std::uint32_t merge) {
        const GlossyOptions own = papers(PapersChoice{merge, true});
        const SolverOptions options{.method = own, .max_shots = 8192, .target_error = 0.0};
        const support::Resident resident(furnace.scene, furnace.rays, furnace.lumels, options);
        GlossyIllumination solver(resident.device, resident.world, furnace.lumels, resident.near,
                                  own);
        EXPECT_TRUE(solve(solver, options));
        const EnergyBalance energy = solver.energy();
        EXPECT_EQ(resident.device.validation_messages(), "");
        return energy.absorbed / energy.emitted;
    };
    const double single = absorbed(0), squares = absorbed(1);
    RecordProperty("single", std::to_string(single));
    RecordProperty("squares", std::to_string(squares));
    EXPECT_NEAR(2.0 * single - squares, 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Materials, PapersClosedRoom,
                         testing::Values(Gloss{glm::vec3(0.5f), glm::vec3(0.0f), 1.0f},
                                         Gloss{glm::vec3(0.3f), glm::vec3(0.3f), 10.0f},
                                         Gloss{glm::vec3(0.0f), glm::vec3(0.5f), 30.0f}));

// The same in a picture: the accumulated image of every lumel and the light that arrives. With
// 6,144 shooters the two losses vary between seeds by 0.7 and 0.5 %, so that 2 × the one - the
// other varies by 1.5 %; with four times as many it is -2.6 %, which is not explained.
TEST(PapersPicture, HasTheLightThatPathsFindButWhatItsShootersLose)
{
    constexpr std::uint64_t kShots = 24'576;
    RenderOptions options;
    options.width = 48;
    options.height = 32;
    options.sets = 4;
    options.bake.atlas.size = 96;
    const Scene scene = read_gltf(support::scene_path("glossy-floor"), MaterialModel::glossy);
    const auto picture = [&](std::uint32_t merge) {
        options.bake.solver = {
            .method = papers(PapersChoice{merge, true}), .max_shots = kShots, .target_error = 0.0};
        return render(scene, options).image;
    };
    const Image single = picture(0), squares = picture(1);
    options.paths = 512;
    const Image truth = render(scene, options).image;
    constexpr double kBelowLamps = 3.0;  // [cd/m²]
    const double single_bias = compare_maps(single, truth, kBelowLamps).bias;
    const double squares_bias = compare_maps(squares, truth, kBelowLamps).bias;
    RecordProperty("single", std::to_string(single_bias));
    RecordProperty("squares", std::to_string(squares_bias));
    EXPECT_NEAR(2.0 * single_bias, squares_bias, 0.02);
}

}  // namespace
}  // namespace lumel
