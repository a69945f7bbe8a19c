#pragma once
// Gather radiosity: a hemicube on every lumel, bounce after bounce [CG85], [Hoef13] 4.2. See
// gather.cpp.

#include <array>

#include "gpu/pacer.h"
#include "methods/gather/gather.bounce.comp.h"
#include "methods/gather/gather.eyes.comp.h"
#include "methods/gather/gather.integrate.comp.h"
#include "methods/gather/gather.multiply.comp.h"
#include "methods/gather/gather.reduce.comp.h"
#include "methods/gather/gather.shared.h"
#include "methods/gather/gather.sums.comp.h"
#include "methods/gather/options.h"
#include "raster/eyes/lit_views.h"
#include "solve/shooting/lumel_sums.h"
#include "solve/solver/solve_size.h"
#include "solve/solver/solver.h"

namespace lumel {

/// Every lumel in turn gathers the light that it sees.
class GatherRadiosity final : public Solver {
public:
    /// `world` must hold the atlas. `shots` are hemicubes.
    GatherRadiosity(const gpu::Device& device, const World& world, const Lumels& lumels,
                    const GatherOptions& options, double target_error);

    /// Upper bound on GPU memory [bytes] for a scene without coloured glass, if the device does not
    /// limit images.
    static std::uint64_t device_bytes(const SolveSize& size, const GatherOptions& options);

    void step() override;
    SolverState state() const override { return state_; }
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return pacer_.times(); }
    double longest_submission() const override { return pacer_.longest_ms(); }

private:
    void place_eyes(std::uint32_t lumels);
    void integrate(std::uint32_t eyes);
    void integrate_by_mipmaps(std::uint32_t eyes);
    void bounce(std::uint32_t lumels);
    void end_bounce();
    double still_to_come(const Terms& terms) const;
    /// Half-solution of this bounce: they alternate.
    std::uint32_t half() const { return taken_[0] > taken_[1] ? 1 : 0; }

    GatherOptions options_;
    double target_error_;  ///< bounces converge to a part of it; 0: none
    std::uint32_t count_;  ///< N lumels
    const World* world_;
    std::uint32_t channels_;  ///< hemicubes per lumel
    float ray_offset_;        ///< distance of eyes from their surface [m]
    gpu::Kernel<shaders::GatherEyes> eyes_kernel_;
    gpu::Kernel<shaders::GatherIntegrate> integrate_;
    gpu::Kernel<shaders::GatherMultiply> multiply_;
    gpu::Kernel<shaders::GatherReduce> reduce_;
    gpu::Kernel<shaders::GatherBounce> bounce_;
    gpu::Kernel<shaders::GatherSums> figures_kernel_;
    LitViews views_;
    std::uint32_t batch_;                 ///< lumels per batch
    gpu::Array<std::uint32_t> order_;     ///< [M] lumels that are not buried
    gpu::Array<std::uint32_t> lumel_of_;  ///< [texels][2]
    std::uint32_t width_, height_;        ///< size of the atlas [texels]
    gpu::Array<float> delta_form_factors_;
    gpu::Array<Eye> eyes_;
    gpu::Array<GatheringPoint> points_;
    gpu::Array<glm::vec3> gathered_;             ///< [K] H of each hemicube
    gpu::Array<glm::vec3> mipmaps_;              ///< [levels][K][pixels], with Integration::mipmap
    gpu::Array<glm::vec4> surface_;              ///< (ρ, A) [N]
    gpu::Array<glm::vec3> emission_;             ///< E [N]
    gpu::Array<glm::vec3> radiosity_;            ///< B [N]
    gpu::Array<glm::vec3> irradiance_, change_;  ///< H, and ΔH of the last bounce [N]
    gpu::Array<glm::vec3> sums_;                 ///< [2][N] sums of H, per half-solution
    LumelSums figures_;
    std::uint32_t next_ = 0;                ///< next lumel of the order
    bool averages_ = false;                 ///< points move, and H is their mean
    std::array<std::uint32_t, 2> taken_{};  ///< bounces in each half-solution
    double apart_ = 0.0;                    ///< relative difference of the halves one bounce ago
    double remaining_ = 0.0;                ///< relative residual when light converged
    SolverState state_;
    gpu::Pacer pacer_;  ///< last member: its destructor waits for work that uses others
};

}  // namespace lumel
