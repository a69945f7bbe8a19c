// Particles along lobes: no power is made or lost.

#include "methods/glossy/lobe_particles.h"

#include "methods/glossy/phong.h"
#include "solve/shooting/lumel_arrays.h"
#include "solved.h"

namespace lumel {
namespace {

/// The furnace with walls of one gloss.
struct GlossyFurnace {
    explicit GlossyFurnace(const Gloss& gloss)
        : world(support::scene_path("furnace-0.5"), AtlasOptions{.size = 32})
    {
        for (Gloss& each : world.lumels.gloss)
            each = gloss;
    }

    double power(const std::vector<glm::vec3>& exitance) const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < exitance.size(); ++i)
            sum += double(world.lumels.lumels[i].area) * luminance(exitance[i]);
        return sum;
    }

    LobeParticles::Carried carry(std::uint32_t seed) const
    {
        const LobeParticles particles(world);
        return particles.carry(emission_of(world.lumels), {}, 200000, seed);
    }

    SolveScene world;
};

class ParticlesOfShininess : public testing::TestWithParam<float> {};

// What arrives from lobes is what they reflect: of light that came from a surface that sends it
// equally in all directions, their mean albedo, and of what particles brought all that they say.
TEST_P(ParticlesOfShininess, BringAllThatLobesReflect)
{
    const float shininess = GetParam();
    const GlossyFurnace furnace({glm::vec3(0.2f), glm::vec3(0.7f, 0.6f, 0.5f), shininess});
    const LobeParticles::Carried carried = furnace.carry(1);

    // Emission is even all over a closed room, so light first arrives as the cosine has it.
    double albedo = 0.0;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
        const double cosine = (i + 0.5) / kSteps;
        albedo += 2.0 * cosine * double(phong_albedo(float(cosine), shininess)) / kSteps;
    }
    std::vector<glm::vec3> first = emission_of(furnace.world.lumels);
    for (glm::vec3& exitance : first)
        exitance *= glm::vec3(0.7f, 0.6f, 0.5f) * float(albedo);
    const double sent = furnace.power(first) + furnace.power(carried.reflected);
    EXPECT_NEAR(furnace.power(carried.irradiance), sent, 0.01 * sent);
}

INSTANTIATE_TEST_SUITE_P(Lobes, ParticlesOfShininess, testing::Values(1.0f, 30.0f, 1000.0f));

TEST(Particles, OfOneSeedBringTheSameBytes)
{
    const GlossyFurnace furnace({glm::vec3(0.2f), glm::vec3(0.6f), 100.0f});
    EXPECT_EQ(furnace.carry(3).irradiance, furnace.carry(3).irradiance);
    EXPECT_NE(furnace.carry(3).irradiance, furnace.carry(4).irradiance);
}

TEST(Particles, AreNotNeededWithoutLobes)
{
    const GlossyFurnace furnace({glm::vec3(0.5f), glm::vec3(0.0f), 1.0f});
    const SolveScene& world = furnace.world;
    EXPECT_FALSE(LobeParticles(world).any());
    for (const glm::vec3& irradiance : furnace.carry(1).irradiance)
        EXPECT_EQ(irradiance, glm::vec3(0.0f));
}

}  // namespace
}  // namespace lumel
