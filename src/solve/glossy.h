#pragma once
// Stochastic glossy global illumination [BSS05]. See glossy.cpp.

#include <array>

#include "gpu/pacer.h"
#include "solve/figures.h"
#include "solve/glossy.shared.h"
#include "solve/near_rows.h"
#include "solve/power_pyramid.h"
#include "solve/solver.h"
#include "visibility/hemicube.h"

namespace lumel {

/// What goes in and out of a solution [lm], by luminance.
struct EnergyBalance {
    double emitted = 0.0;
    double absorbed = 0.0;
};

/// Shooters drawn by power send diffuse light and the lobes of their last irradiance.
class GlossyIllumination final : public Solver {
public:
    GlossyIllumination(const gpu::Device& device, const World& world, const Lumels& lumels,
                       const NearField& near, const SolverOptions& options);

    void step() override;
    SolverState state() const override { return state_; }
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return pacer_.times(); }
    double longest_submission() const override { return pacer_.longest_ms(); }

    /// Of the solution so far. Waits for the device.
    EnergyBalance energy();

private:
    struct Kernels {
        explicit Kernels(const gpu::Device& device);
        gpu::Kernel select, receive, evaluate;
    };

    void begin();
    void select();
    void receive();
    void restart();
    void evaluate(gpu::Commands& commands);
    void take_figures();

    SolverOptions options_;
    std::uint32_t count_;  ///< N lumels
    std::uint32_t batch_;  ///< K
    bool paper_;
    float near_radius_;
    double emitted_power_ = 0.0;  ///< Σ A 𝓛(E) [lm]

    const World* world_;
    Kernels kernels_;
    Hemicubes hemicubes_;
    gpu::Array<Eye> eyes_[2];  ///< this iteration's and the one's before, by turns
    gpu::Array<GlossyShot> shots_;
    gpu::Array<glm::vec4> surface_;   ///< ρ, A; A = 0 for buried lumels
    gpu::Array<Gloss> gloss_;         ///< [N]
    gpu::Array<float> albedo_table_;  ///< phong_albedo_table
    gpu::Array<glm::vec3> emission_;  ///< E
    gpu::Array<glm::vec3> exitance_;  ///< [N] B of the last iteration
    gpu::Array<glm::vec3> diffuse_;   ///< [N] the part of it that is the same in all directions
    gpu::Array<glm::vec3> near_;      ///< [N] near light of the B before it
    gpu::Array<glm::vec3> last_;      ///< [K][N] actual irradiance of the last iteration
    gpu::Array<glm::vec3> sums_, absorbed_;  ///< [2][N] since the last restart
    gpu::Array<glm::vec3> irradiance_;
    Figures figures_;
    NearRows near_rows_;
    PowerPyramid power_;
    gpu::Pacer pacer_;  ///< after all that its work uses: it waits when it ends

    SolverState state_;
    std::array<float, 2> batches_{};  ///< iterations in sums, per half
};

}  // namespace lumel
