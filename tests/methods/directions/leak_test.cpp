// Leaky integration: what counts of what was received, and how light that changes is followed.

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "methods/directions/directions.h"

namespace lumel {
namespace {

constexpr double kLeak = 0.01;  // the paper's

/// A closed room of 1 m whose walls all shine alike.
struct Furnace {
    explicit Furnace(float albedo)
    {
        std::vector<support::Quad> quads;
        for (const support::Quad& wall : support::box_walls(glm::vec3(0.0f), glm::vec3(1.0f), true,
                                                            {.albedo = glm::vec3(albedo),
                                                            .emission = glm::vec3(1.0f),
                                                            .res_u = 4,
                                                            .res_v = 4}))
            quads.push_back(wall);
        made = support::make_quads(quads);
        atlas = support::lay_out(made, quads);
    }

    /// Lets the walls emit this much.
    void shine(float emission)
    {
        for (Lumel& lumel : made.lumels.lumels)
            lumel.emission = glm::vec3(emission);
    }

    support::HandMade made;
    Atlas atlas;
};

/// A furnace and the directions that light it.
struct Lit {
    Lit(float albedo, double leak, int batch)
        : furnace(albedo),
          world(device, furnace.made.scene, furnace.made.lumels, &furnace.atlas),
          solver(device, world, furnace.made.lumels,
                 {.batch = batch, .iteration = {Scheme::paper, leak}, .map_side = 64})
    {
    }
    ~Lit() { EXPECT_EQ(device.validation_messages(), ""); }

    void step(int times)
    {
        for (int i = 0; i < times; ++i)
            solver.step();
    }
    void shine(float emission)
    {
        furnace.shine(emission);
        solver.relight(furnace.made.lumels);
    }
    double mean()
    {
        double sum = 0.0;
        for (const glm::vec3& irradiance : solver.irradiance())
            sum += double(irradiance.g);
        return sum / double(furnace.made.lumels.lumels.size());
    }

    gpu::Device device;
    Furnace furnace;
    World world;
    GlobalDirections solver;
};

TEST(Leak, TheFirstDirectionCountsTheLeakAndLessWithEveryOther)
{
    constexpr int kDirections = 50;
    Lit averaged(0.0f, 0.0, 1), lit(0.0f, kLeak, 1);
    averaged.step(1);
    lit.step(1);
    const std::vector<glm::vec3> whole = averaged.solver.irradiance();
    lit.shine(0.0f);
    lit.step(kDirections - 1);
    const std::vector<glm::vec3> left = lit.solver.irradiance();
    const double weight = kLeak * std::pow(1.0 - kLeak, kDirections - 1);
    float most = 0.0f;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_NEAR(double(left[i].g), weight * double(whole[i].g), 1e-5 * weight) << "lumel " << i;
        most = std::max(most, whole[i].g);
    }
    EXPECT_GT(most, 0.5f);
}

// Of one direction in a cube, the mean over the lumels spreads by 10 % about the true one, and of
// leaky means of those by less than 1 %.

TEST(Leak, LightThatChangesIsFollowed)
{
    constexpr int kBatch = 4, kBefore = 150, kAfter = 25;
    Lit lit(0.0f, kLeak, kBatch);
    lit.step(kBefore);
    EXPECT_NEAR(lit.mean(), 1.0, 0.03);
    lit.shine(3.0f);
    lit.step(kAfter);
    const double of_before = std::pow(1.0 - kLeak, kBatch * kAfter);
    EXPECT_NEAR(lit.mean(), 3.0 - 2.0 * of_before, 3.0 * 0.03);
    lit.step(kBefore);
    EXPECT_NEAR(lit.mean(), 3.0, 3.0 * 0.03);
}

TEST(Leak, ConstantLightKeepsItsMean)
{
    constexpr int kReadings = 8;
    Lit lit(0.5f, kLeak, 4);
    lit.step(400);
    double sum = 0.0;
    for (int i = 0; i < kReadings; ++i) {
        lit.step(50);
        sum += lit.mean() / kReadings;
    }
    EXPECT_NEAR(sum, 2.0, 0.02 * 2.0);  // E/(1 - ρ)
}

TEST(Leak, IsNotForWhatConverges)
{
    EXPECT_THROW(Lit(0.0f, 1.0, 1), Error);
    Lit averaged(0.0f, 0.0, 1);
    EXPECT_THROW(averaged.shine(0.0f), Error);
}

}  // namespace
}  // namespace lumel
