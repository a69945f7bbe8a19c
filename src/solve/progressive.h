#pragma once
// Progressive refinement radiosity [Hoef13] 4.3. See progressive.cpp.

#include "gpu/pacer.h"
#include "solve/figures.h"
#include "solve/near_rows.h"
#include "solve/patches.h"
#include "solve/progressive.shared.h"
#include "solve/solver.h"
#include "visibility/eye_views.h"

namespace lumel {

/// The patches with the most unshot light shoot first.
class ProgressiveRadiosity final : public Solver {
public:
    ProgressiveRadiosity(const gpu::Device& device, const World& world, const Lumels& lumels,
                         const NearField& near, const SolverOptions& options);

    void step() override;
    SolverState state() const override { return state_; }
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return pacer_.times(); }
    double longest_submission() const override { return pacer_.longest_ms(); }

private:
    void choose();
    void take(gpu::Commands& commands);
    void receive();
    void settle();
    void light_near(gpu::Commands& commands);
    void ask_figures();
    void take_figures();

    std::uint32_t count_;  ///< N lumels
    float near_radius_;
    double emitted_power_;  ///< Σ A 𝓛(E) [lm]
    float area_;            ///< Σ A [m²]

    const World* world_;
    gpu::Kernel power_, select_, take_, receive_, settle_, residual_;
    EyeViews views_;
    std::uint32_t batch_;  ///< K
    Patches layout_;
    gpu::Array<Patch> patches_;
    gpu::Array<PatchChart> charts_;
    gpu::Array<ChartLight> chart_light_;  ///< [C]
    gpu::Array<glm::vec3> ambient_;       ///< [1] light still to arrive, spread evenly [lx]
    gpu::Array<std::uint32_t> levels_;    ///< [C]
    gpu::Array<Cursor> cursor_;           ///< [1]
    gpu::Array<ChosenPatch> chosen_;      ///< [K]
    gpu::Array<Eye> eyes_;                ///< [K]
    gpu::Array<PatchShot> shots_;         ///< [K]
    gpu::Array<glm::vec4> surface_;       ///< [N] ρ, A; A = 0 for buried lumels
    gpu::Array<glm::vec3> emission_;      ///< [N] E
    gpu::Array<glm::vec3> shot_;          ///< [N] B^s, shot so far
    gpu::Array<glm::vec3> sending_;       ///< [N] part of B^u that a point of this batch sends
    gpu::Array<glm::vec3> far_, near_;    ///< [N] H of the shot light
    NearRows near_rows_;
    Figures figures_;
    SolverState state_;
    gpu::Pacer pacer_;  ///< after all that its work uses: it waits when it ends
};

}  // namespace lumel
