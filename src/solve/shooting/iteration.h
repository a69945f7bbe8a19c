#pragma once
// Averages the batches of solvers whose transport operator T* is random, with expectation T, into a
// solution of B = E + ρ T B. Schemes and equations: iteration.cpp.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "gpu/pacer.h"
#include "raster/near/near_rows.h"
#include "solve/shooting/iteration.advance.comp.h"
#include "solve/shooting/iteration.balance.comp.h"
#include "solve/shooting/iteration.evaluate.comp.h"
#include "solve/shooting/iteration.fade.comp.h"
#include "solve/shooting/iteration.polish.comp.h"
#include "solve/shooting/iteration.shared.h"
#include "solve/shooting/iteration_options.h"
#include "solve/shooting/lumel_sums.h"
#include "solve/solver/solver_state.h"

namespace lumel {

/// Two half-solutions on the GPU. For each batch the solver calls begin_batch(), adds T* E to
/// direct() and T* X to indirect() in the half given by half(), and calls finish_batch(). X is the
/// light to shoot again: ρH with Scheme::phased, E + ρH with Scheme::paper, which adds nothing to
/// direct().
///
/// state().error is estimated from the spread of the halves and read back a fixed number of
/// iterations late, so that timing cannot change a result.
class Iteration {
public:
    /// batch: shots per batch. Scheme::paper does not use the near field. known:
    /// SolverInputs::known.
    Iteration(const gpu::Device& device, const Lumels& lumels, const NearField& near,
              std::span<const glm::vec3> known, const IterationOptions& options,
              std::uint32_t batch);

    /// Clears all sums; X is 0, or E with Scheme::paper.
    void begin(gpu::Pacer& pacer);
    /// Scheme::phased, before the first batch: X [N] of the first phase, a guess of ρH. Otherwise
    /// that phase sends E alone. Waits for the device.
    void start_from(gpu::Pacer& pacer, std::span<const glm::vec3> source);
    /// GPU memory [bytes].
    static std::uint64_t device_bytes(std::size_t lumel_count, std::uint64_t near_pairs);

    /// Call before each batch: reads back due statistics and decays leaky sums.
    void begin_batch(gpu::Pacer& pacer);
    /// Ends a batch of this number of shots into direct() and indirect(). Returns true if X
    /// changed.
    bool finish_batch(gpu::Pacer& pacer, std::uint32_t emission_shots, std::uint32_t source_shots);
    /// Takes E, ρ and A from `lumels`. Waits for the device. Throws Error{input} unless the sums
    /// are leaky: others would keep earlier light.
    void relight(gpu::Pacer& pacer, const Lumels& lumels);
    /// Current H [N] [lx]. Waits for the device.
    std::vector<glm::vec3> irradiance(gpu::Pacer& pacer);

    std::uint32_t lumels() const { return count_; }
    const SolverState& state() const { return state_; }
    std::uint32_t half() const { return phase_batch_ % 2; }
    std::uint32_t phase() const { return phase_; }                 ///< changes with X
    bool sends_reflected() const { return paper_ || phase_ > 0; }  ///< false: X is still 0
    /// Shots of this half-solution since the first batch.
    std::uint32_t emission_index() const { return emission_index_[half()]; }
    std::uint32_t source_index() const { return source_index_[half()]; }
    /// Power of E relative to all emitted power, 0…1, at the last readback.
    double emission_share() const { return emission_share_; }

    const gpu::Array<glm::vec4>& surface() const { return surface_; }    ///< (ρ, A) [N]
    const gpu::Array<glm::vec3>& emission() const { return emission_; }  ///< E [N]
    const gpu::Array<glm::vec3>& source() const { return source_; }      ///< X [N]
    const gpu::Array<glm::vec3>& direct() const { return direct_; }      ///< [2][N] sums
    const gpu::Array<glm::vec3>& indirect() const { return indirect_; }  ///< [2][N] sums

private:
    bool leaks() const { return kept_ < 1.0; }
    void take_figures(gpu::Pacer& pacer);
    void evaluate(gpu::Commands& commands);
    void advance(gpu::Pacer& pacer);
    void end_phase();
    Averages averages() const;

    std::uint32_t count_;  ///< N lumels
    std::uint32_t batch_;
    bool paper_;
    double kept_;           ///< fraction of the sums that remains after a batch
    double emitted_power_;  ///< Σ A 𝓛(E) [lm]
    double known_sum_;      ///< Σ of `known` [lx]

    gpu::Kernel<shaders::IterationBalance> balance_;
    gpu::Kernel<shaders::IterationEvaluate> evaluate_;
    gpu::Kernel<shaders::IterationAdvance> advance_;
    gpu::Kernel<shaders::IterationPolish> polish_;
    gpu::Kernel<shaders::IterationFade> fade_;
    gpu::Array<glm::vec4> surface_;   ///< ρ, A; A = 0 for buried lumels
    gpu::Array<glm::vec3> emission_;  ///< E
    gpu::Array<glm::vec3> known_;     ///< given irradiance H
    gpu::Array<glm::vec3> source_;    ///< X: reflected light to shoot
    gpu::Array<glm::vec3> direct_;    ///< [2][N] sums over shots of E
    gpu::Array<glm::vec3> indirect_;  ///< [2][N] sums over shots of X, this phase
    gpu::Array<glm::vec3> earlier_;   ///< [2][N] U: far light for unit source power, earlier phases
    gpu::Array<glm::vec3> near_emission_;  ///< near light of E
    gpu::Array<glm::vec3> near_source_;    ///< near light of X
    gpu::Array<glm::vec3> far_, irradiance_, scratch_source_, scratch_near_;
    NearRows near_rows_;
    gpu::Array<Terms> totals_;  ///< sums of the energy balance
    LumelSums figures_;

    SolverState state_;
    double mean_irradiance_ = 0.0;  ///< at the last readback [lx]
    std::uint32_t phase_ = 0;
    std::uint32_t phase_batch_ = 0;  ///< batches done in this phase
    std::uint32_t phase_length_;     ///< batches in this phase
    double emission_share_ = 1.0;
    std::array<std::uint32_t, 2> emission_index_{}, source_index_{};
    std::array<float, 2> phase_source_shots_{}, earlier_weight_{};
};

}  // namespace lumel
