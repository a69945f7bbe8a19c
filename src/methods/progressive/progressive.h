#pragma once
// Progressive refinement radiosity [Hoef13] 4.3. See progressive.cpp.

#include "methods/progressive/options.h"
#include "methods/progressive/progressive.power.comp.h"
#include "methods/progressive/progressive.receive.comp.h"
#include "methods/progressive/progressive.residual.comp.h"
#include "methods/progressive/progressive.select.comp.h"
#include "methods/progressive/progressive.settle.comp.h"
#include "methods/progressive/progressive.shared.h"
#include "solve/shooting/lumel_sums.h"
#include "solve/solver/solve_size.h"
#include "solve/solver/solver.h"
#include "solve/transport/patch_shots.h"

namespace lumel {

/// Shoots from the patches with the most unshot light first.
class ProgressiveRadiosity final : public Solver {
public:
    ProgressiveRadiosity(const gpu::Device& device, const World& world, const Lumels& lumels,
                         const NearField& near, const ProgressiveOptions& options);

    /// Upper bound on GPU memory [bytes], if the device does not limit images.
    static std::uint64_t device_bytes(const SolveSize& size, const ProgressiveOptions& options);

    void step() override;
    SolverState state() const override { return state_; }
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return pacer_.times(); }
    double longest_submission() const override { return pacer_.longest_ms(); }

    /// Unshot light with its future bounces, relative to the arrived light (in a scene gone dark:
    /// to 1 % of its peak). Waits for the device.
    double residual();

    // For redistribution.
    ShotLight& light() { return light_; }
    PatchShots& shots() { return shots_; }
    gpu::Pacer& pacer() { return pacer_; }
    float near_radius() const { return near_radius_; }
    /// Adds the light of the batch in shots() to lumels. Requires that it is taken and rendered.
    void receive();
    /// Marks the light of that batch as shot.
    void settle();
    /// Replaces the near field by one of the same radius.
    void set_near_field(const NearField& near);

private:
    void choose();
    void light_near(gpu::Commands& commands);
    void sum_figures(gpu::Commands& commands);
    void ask_figures();
    void take_figures();

    const World* world_;
    std::uint32_t count_;  ///< N lumels
    float near_radius_;
    float patch_share_;          ///< maximum part of all light per patch
    double emitted_power_;       ///< Σ A 𝓛(E) [lm]
    float area_;                 ///< Σ A [m²]
    double most_arrived_ = 0.0;  ///< maximum of arrived light in residual() [lm]

    gpu::Kernel<shaders::ProgressivePower> power_;
    gpu::Kernel<shaders::ProgressiveSelect> select_;
    gpu::Kernel<shaders::ProgressiveReceive> receive_;
    gpu::Kernel<shaders::ProgressiveSettle> settle_;
    gpu::Kernel<shaders::ProgressiveResidual> residual_;
    ShotLight light_;
    PatchShots shots_;
    gpu::Array<ChartLight> chart_light_;  ///< [C]
    gpu::Array<glm::vec3> ambient_;       ///< [1] light still to arrive, spread evenly [lx]
    gpu::Array<Cursor> cursor_;           ///< [1]
    NearRows near_rows_;
    LumelSums figures_;
    SolverState state_;
    gpu::Pacer pacer_;  ///< last member: its destructor waits for work that uses others
};

}  // namespace lumel
