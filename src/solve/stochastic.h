#pragma once
// Stochastic radiosity by perspective ray bundles [BJ04], [BSS05]. See stochastic.cpp.

#include <array>

#include "gpu/pacer.h"
#include "solve/figures.h"
#include "solve/near_rows.h"
#include "solve/power_pyramid.h"
#include "solve/solver.h"
#include "solve/stochastic.shared.h"
#include "visibility/eye_views.h"

namespace lumel {

/// Shooters drawn by power send their light to all lumels that they see, at once.
class StochasticRadiosity final : public Solver {
public:
    StochasticRadiosity(const gpu::Device& device, const World& world, const Lumels& lumels,
                        const NearField& near, const SolverOptions& options);

    void step() override;
    SolverState state() const override { return state_; }
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return pacer_.times(); }
    double longest_submission() const override { return pacer_.longest_ms(); }

private:
    struct Kernels {
        Kernels(const gpu::Device& device, Projection projection);
        gpu::Kernel select, receive, balance, evaluate, advance, polish;
    };

    void shoot();
    void select(gpu::Commands& commands, std::uint32_t emission_shots);
    void evaluate(gpu::Commands& commands);
    void advance();
    void take_figures();
    std::uint32_t emission_shots_of_batch();
    Averages averages() const;

    SolverOptions options_;
    std::uint32_t count_;  ///< N lumels
    std::uint32_t batch_;  ///< K
    bool paper_;
    float near_radius_;
    float reflecting_area_;  ///< Σ A of lumels with albedo > 0 [m²]
    double emitted_power_;   ///< Σ A 𝓛(E) [lm]

    const World* world_;
    Kernels kernels_;
    EyeViews views_;
    gpu::Array<Eye> eyes_;
    gpu::Array<Shot> shots_;
    gpu::Array<glm::vec4> surface_;   ///< ρ, A; A = 0 for buried lumels
    gpu::Array<glm::vec3> emission_;  ///< E
    gpu::Array<glm::vec3> source_;    ///< X: what indirect shooters send
    gpu::Array<glm::vec3> direct_;    ///< [2][N] sums over shots drawn from E
    gpu::Array<glm::vec3> indirect_;  ///< [2][N] sums over shots drawn from X, this phase
    gpu::Array<glm::vec3>
        earlier_;  ///< [2][N] U: far light for unit source power, of earlier phases
    gpu::Array<glm::vec3> near_emission_;  ///< near light of E
    gpu::Array<glm::vec3> near_source_;    ///< near light of X
    gpu::Array<glm::vec3> far_, irradiance_, scratch_source_, scratch_near_;
    NearRows near_rows_;
    gpu::Array<Terms> totals_;  ///< of the energy balance
    Figures figures_;
    PowerPyramid emission_power_pyramid_, source_power_pyramid_;
    gpu::Pacer pacer_;  ///< after all that its work uses: it waits when it ends

    SolverState state_;
    double mean_irradiance_ = 0.0;  ///< as last heard [lx]
    std::uint32_t phase_ = 0;
    std::uint32_t phase_batch_ = 0;  ///< batches done in this phase
    std::uint32_t phase_length_;     ///< batches in this phase
    double emission_share_ = 1.0;    ///< of the shooters that are drawn from E
    double emission_owed_ = 0.0;     ///< fraction of a shooter carried to the next batch
    std::array<std::uint32_t, 2> emission_index_{}, source_index_{};
    std::array<float, 2> phase_source_shots_{}, earlier_weight_{};
};

}  // namespace lumel
