// The iterations of [BJ04] and [BSS05] as published, term by term: every iteration is the light of
// one texel at its centre.

#include <cmath>

#include "../support/box_lumels.h"
#include "atlas/near/world_lumels.h"
#include "methods/glossy/glossy.h"
#include "methods/stochastic/stochastic.h"
#include "solved.h"

namespace lumel {
namespace {

constexpr int kIterations = 12;
constexpr double kEmission = 1.0, kAlbedo = 0.5;  // of the furnace
/// Rounding of single precision, in sums of `kIterations`.
constexpr double kRounding = 1e-4;

/// The furnace of 16², which hides nothing.
struct SmallFurnace : SolveScene {
    SmallFurnace()
        : SolveScene(support::scene_path("furnace-0.5"), AtlasOptions{.size = 16}),
          standing(scene, rays, lumels)
    {
        for (Gloss& gloss : lumels.gloss)
            gloss = {glm::vec3(float(kAlbedo)), glm::vec3(0.0f), 1.0f};
    }

    double area(std::size_t j) const { return double(lumels.lumels[j].area); }

    /// cosθ_i cosθ_j / (r² + d) between centres.
    double factor(std::size_t i, std::size_t j, double disc) const
    {
        const glm::dvec3 step(standing[i].centre - standing[j].centre);
        const double out = glm::dot(step, glm::dvec3(standing[j].normal));
        const double in = -glm::dot(step, glm::dvec3(standing[i].normal));
        const double r2 = glm::dot(step, step);
        return i == j || out <= 0.0 || in <= 0.0 ? 0.0 : out * in / (r2 * (r2 + disc));
    }

    WorldLumels standing;
};

/// How far `light` [lx] is, at its worst lumel and in terms of its mean, from that of the texel
/// which sends the most similar light: Φ / π · cosθ cosθ / (r² + d), with p_j = 𝓛(X_j) A_j / Φ.
double distance_to_one_texel(const SmallFurnace& furnace, const std::vector<double>& light,
                             double power, bool disc)
{
    double sum = 0.0, best = std::numeric_limits<double>::infinity();
    for (const double value : light)
        sum += value;
    for (std::size_t j = 0; j < light.size(); ++j) {
        double worst = 0.0;
        for (std::size_t i = 0; i < light.size(); ++i)
            worst = std::max(
                worst,
                std::abs(light[i] -
                         power / support::kPi *
                             furnace.factor(i, j, disc ? furnace.area(j) / support::kPi : 0.0)));
        best = std::min(best, worst);
    }
    return best * double(light.size()) / sum;
}

/// Checks m H_m - (m - 1) H_{m-1}, the light of iteration m: the texel that sent it was drawn from
/// the mean H_{m-1} (`from_mean`), or from the light of iteration m - 1.
void expect_one_texel_an_iteration(Solver& solver, const SmallFurnace& furnace, bool from_mean,
                                   bool disc)
{
    const std::size_t count = furnace.lumels.lumels.size();
    std::vector<double> sum(count, 0.0), light(count, 0.0);
    for (int m = 1; m <= kIterations; ++m) {
        double power = 0.0;  // Φ = Σ A (E + ρ H)
        for (std::size_t j = 0; j < count; ++j)
            power += furnace.area(j) *
                     (kEmission + kAlbedo * (from_mean && m > 1 ? sum[j] / (m - 1) : light[j]));
        solver.step();
        const std::vector<glm::vec3> mean = solver.irradiance();
        for (std::size_t i = 0; i < count; ++i) {
            light[i] = m * double(mean[i].g) - sum[i];
            sum[i] = m * double(mean[i].g);
        }
        EXPECT_LE(distance_to_one_texel(furnace, light, power, disc), kIterations * kRounding)
            << "iteration " << m;
    }
}

class PapersProjection : public testing::TestWithParam<Projection> {};

INSTANTIATE_TEST_SUITE_P(Of, PapersProjection,
                         testing::Values(Projection::hemicube, Projection::hemisphere));

/// The iteration of [BJ04], with r² alone or with the disc of [BSS05] Eq. (8).
void expect_the_mean_is_sent(Projection projection, bool disc)
{
    const SmallFurnace furnace;
    const StochasticOptions own{.views = {.projection = projection, .hemicube = 256, .batch = 1},
                                .rule = SampleRule::centre,
                                .iteration = {Scheme::paper},
                                .disc = disc};
    const support::Resident resident(furnace.scene, furnace.rays, furnace.lumels, {.method = own});
    StochasticRadiosity solver(resident.device, resident.world, furnace.lumels, resident.near, own);
    expect_one_texel_an_iteration(solver, furnace, true, disc);
    EXPECT_EQ(resident.device.validation_messages(), "");
}

TEST_P(PapersProjection, OfBarsiAndJakabSendsTheMeanOfAllIterationsFromOneTexel)
{
    expect_the_mean_is_sent(GetParam(), false);
}

TEST_P(PapersProjection, OfBarsiAndJakabCanSendItFromDiscs)
{
    expect_the_mean_is_sent(GetParam(), true);
}

TEST_P(PapersProjection, OfBarsiAndOthersSendsTheLastIterationFromOneTexel)
{
    const SmallFurnace furnace;
    const GlossyOptions own{.views = {.projection = GetParam(), .hemicube = 256, .batch = 1},
                            .rule = SampleRule::centre,
                            .scheme = Scheme::paper,
                            .merge = 0,
                            .two_choices = false};
    const support::Resident resident(furnace.scene, furnace.rays, furnace.lumels, {.method = own});
    GlossyIllumination solver(resident.device, resident.world, furnace.lumels, resident.near, own);
    expect_one_texel_an_iteration(solver, furnace, false, true);
    EXPECT_EQ(resident.device.validation_messages(), "");
}

}  // namespace
}  // namespace lumel
