#pragma once
// Stochastic radiosity by perspective ray bundles [BJ04], [BSS05]. See stochastic.cpp.

#include <functional>

#include "gpu/pacer.h"
#include "methods/stochastic/options.h"
#include "methods/stochastic/stochastic.receive.comp.h"
#include "methods/stochastic/stochastic.shared.h"
#include "raster/eyes/eye_views.h"
#include "solve/shooting/iteration.h"
#include "solve/shooting/power_pyramid.h"
#include "solve/shooting/shooters.select.comp.h"
#include "solve/solver/solve_size.h"
#include "solve/solver/solver.h"

namespace lumel {

/// Adds light that shooters do not carry to the sums of a batch, before it is finished.
using OtherLight = std::function<void(gpu::Pacer& pacer, const Iteration& iteration,
                                      std::uint32_t emission_shots)>;

/// Shooters drawn by power send their light to all lumels that they see, at once.
class StochasticRadiosity final : public Solver {
public:
    StochasticRadiosity(const gpu::Device& device, const World& world, const Lumels& lumels,
                        const NearField& near, const StochasticOptions& options,
                        std::span<const glm::vec3> known = {}, OtherLight other = {});

    /// Upper bound on GPU memory [bytes], if the device does not limit images.
    static std::uint64_t device_bytes(const SolveSize& size, const StochasticOptions& options);

    /// See Iteration::start_from.
    void start_from(std::span<const glm::vec3> source);
    void step() override;
    SolverState state() const override { return iteration_.state(); }
    std::vector<glm::vec3> irradiance() override { return iteration_.irradiance(pacer_); }
    const gpu::StageTimes& times() const override { return pacer_.times(); }
    double longest_submission() const override { return pacer_.longest_ms(); }
    std::uint32_t batch() const { return batch_; }  ///< K

private:
    void select(std::uint32_t emission_shots);
    void receive(std::uint32_t emission_shots);
    void build_source_pyramid();
    std::uint32_t emission_shots_of_batch();

    StochasticOptions options_;
    std::uint32_t atlas_width_;  ///< [texels]
    bool paper_;
    float near_radius_;
    float reflecting_area_;  ///< Σ A of lumels with albedo > 0 [m²]

    const World* world_;
    gpu::Kernel<shaders::ShootersSelect> select_;
    gpu::Kernel<shaders::StochasticReceive> receive_;
    EyeViews views_;
    std::uint32_t batch_;  ///< K
    gpu::Array<Eye> eyes_;
    gpu::Array<Shot> shots_;
    Iteration iteration_;
    OtherLight other_;
    PowerPyramid emission_power_pyramid_, source_power_pyramid_;
    gpu::Pacer pacer_;            ///< last member: its destructor waits for work that uses others
    double emission_owed_ = 0.0;  ///< fraction of a shooter carried to the next batch
};

}  // namespace lumel
