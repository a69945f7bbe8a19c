#pragma once
// The iteration scheme of solvers whose transport is random: what is averaged, and when light that
// was received is sent on. See iteration.cpp.

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

/// Averages of a transport that acts, batch by batch, on E and on a source X of reflected light.
/// A transport adds T* E of a batch to the half-solution half() of direct(), T* X to that of
/// indirect(), and then calls finish_batch().
class Iteration {
public:
    /// batch: shots of one batch. With Scheme::paper the near field is not used. `known` as
    /// make_solver takes it.
    Iteration(const gpu::Device& device, const Lumels& lumels, const NearField& near,
              std::span<const glm::vec3> known, const IterationOptions& options,
              std::uint32_t batch);

    /// Clears all sums; X is 0, or E with Scheme::paper.
    void begin(gpu::Pacer& pacer);
    /// Bytes on the device.
    static std::uint64_t device_bytes(std::size_t lumel_count, std::uint64_t near_pairs);

    /// Before each batch: hears figures that are due, and lets leaky sums fade.
    void begin_batch(gpu::Pacer& pacer);
    /// Ends a batch: so many shots went into direct() and into indirect(). Returns true if X is
    /// new.
    bool finish_batch(gpu::Pacer& pacer, std::uint32_t emission_shots, std::uint32_t source_shots);
    /// E, ρ and A are those of `lumels` from now on. Waits for the device. Throws Error{input}
    /// unless the sums are leaky: others would keep the light of before.
    void relight(gpu::Pacer& pacer, const Lumels& lumels);
    /// H [N] [lx] so far. Waits for the device.
    std::vector<glm::vec3> irradiance(gpu::Pacer& pacer);

    std::uint32_t lumels() const { return count_; }
    const SolverState& state() const { return state_; }
    std::uint32_t half() const { return phase_batch_ % 2; }
    bool sends_reflected() const { return paper_ || phase_ > 0; }  ///< false: X is still 0
    /// Shots so far of this half-solution, since the first batch.
    std::uint32_t emission_index() const { return emission_index_[half()]; }
    std::uint32_t source_index() const { return source_index_[half()]; }
    /// Power of E as a part of all that is sent, 0…1, as last heard.
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
    double kept_;           ///< part of the sums that a batch leaves of those before it
    double emitted_power_;  ///< Σ A 𝓛(E) [lm]
    double known_sum_;      ///< Σ of `known` [lx]

    gpu::Kernel<shaders::IterationBalance> balance_;
    gpu::Kernel<shaders::IterationEvaluate> evaluate_;
    gpu::Kernel<shaders::IterationAdvance> advance_;
    gpu::Kernel<shaders::IterationPolish> polish_;
    gpu::Kernel<shaders::IterationFade> fade_;
    gpu::Array<glm::vec4> surface_;   ///< ρ, A; A = 0 for buried lumels
    gpu::Array<glm::vec3> emission_;  ///< E
    gpu::Array<glm::vec3> known_;     ///< H that is received beside what is found here
    gpu::Array<glm::vec3> source_;    ///< X: reflected light to be sent
    gpu::Array<glm::vec3> direct_;    ///< [2][N] sums over shots of E
    gpu::Array<glm::vec3> indirect_;  ///< [2][N] sums over shots of X, this phase
    gpu::Array<glm::vec3>
        earlier_;  ///< [2][N] U: far light for unit source power, of earlier phases
    gpu::Array<glm::vec3> near_emission_;  ///< near light of E
    gpu::Array<glm::vec3> near_source_;    ///< near light of X
    gpu::Array<glm::vec3> far_, irradiance_, scratch_source_, scratch_near_;
    NearRows near_rows_;
    gpu::Array<Terms> totals_;  ///< of the energy balance
    LumelSums figures_;

    SolverState state_;
    double mean_irradiance_ = 0.0;  ///< as last heard [lx]
    std::uint32_t phase_ = 0;
    std::uint32_t phase_batch_ = 0;  ///< batches done in this phase
    std::uint32_t phase_length_;     ///< batches in this phase
    double emission_share_ = 1.0;
    std::array<std::uint32_t, 2> emission_index_{}, source_index_{};
    std::array<float, 2> phase_source_shots_{}, earlier_weight_{};
};

}  // namespace lumel
