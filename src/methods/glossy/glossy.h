#pragma once
// Stochastic glossy global illumination [BSS05]. See glossy.cpp.

#include <array>
#include <optional>
#include <span>

#include "gpu/pacer.h"
#include "methods/glossy/carried_light.h"
#include "methods/glossy/eye_image.h"
#include "methods/glossy/glossy.evaluate.comp.h"
#include "methods/glossy/glossy.receive.comp.h"
#include "methods/glossy/glossy.select.comp.h"
#include "methods/glossy/glossy.shared.h"
#include "methods/glossy/lobe_particles.h"
#include "methods/glossy/options.h"
#include "methods/glossy/phase_particles.h"
#include "methods/stochastic/stochastic.h"
#include "raster/eyes/eye_views.h"
#include "raster/near/near_rows.h"
#include "solve/shooting/lumel_sums.h"
#include "solve/shooting/power_pyramid.h"
#include "solve/solver/solve_size.h"
#include "solve/solver/solver.h"

namespace lumel {

/// Energy of a solution [lm], by luminance.
struct EnergyBalance {
    double emitted = 0.0;
    double absorbed = 0.0;
};

/// Shooters drawn by power send diffuse light and the lobes of their last irradiance.
class GlossyIllumination final : public Solver {
public:
    /// known: [N] [lx] light of sky and lamps, or empty. particles: carry the light of lobes,
    /// also of `known`, instead of the shooters; not with Scheme::paper. Must outlive this.
    /// first_emission: SolverInputs::first_emission; particles carry it too.
    GlossyIllumination(const gpu::Device& device, const World& world, const Lumels& lumels,
                       const NearField& near, const GlossyOptions& options,
                       std::span<const glm::vec3> known = {},
                       const LobeParticles* particles = nullptr,
                       std::span<const glm::vec3> first_emission = {});

    /// Upper bound on GPU memory without an eye [bytes], if the device does not limit images.
    static std::uint64_t device_bytes(const SolveSize& size, const GlossyOptions& options);
    /// Upper bound on host memory of particles [bytes].
    static std::uint64_t host_bytes(std::size_t lumels, const GlossyOptions& options);

    void step() override;
    SolverState state() const override { return state_; }
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override;
    double longest_submission() const override;

    /// Energy balance of the current solution; light of sky and lamps does not count. Waits for the
    /// device.
    EnergyBalance energy();

    /// Starts a frame with emission E [N] [lm/m²]. All frames continue from the same iteration as
    /// the first, with the same random numbers and shooters; the averages of lumels and eye
    /// restart. If the light differs much from the first frame, that is noisy: call
    /// forget_frames(). Waits for the device.
    void set_emission(std::span<const glm::vec3> emission);

    /// [N] 𝓛(B_j) / Φ [1/m²]: approximate density by which the next shooters are drawn. Waits for
    /// the device.
    std::vector<float> brightness();
    /// Makes the next frame the first. Waits for the device.
    void forget_frames();

    /// Starts from the solution of the frame `before` of the same lumels, in which objects were
    /// elsewhere: the iteration from its light, the average from its average, weighted like `kept`
    /// iterations. Without the latter, frames of equal seed share much of their noise. Call before
    /// the first step. Waits for the device.
    void go_on_from(GlossyIllumination& before, float kept = 0.0f);
    /// Iterations in the average since the last restart, without those of earlier frames.
    std::uint64_t averaged() const { return averaged_; }

    /// Starts a frame for another eye: every step also adds to the image at these points. It
    /// continues as other frames do, so that all eyes receive from the same shooters and close eyes
    /// see the same noise. Waits for the device.
    void look_at(std::span<const EyePoint> points, std::span<const float> brightness,
                 const EyeSampling& sampling);
    /// Every step also adds the light that shooters alone make these points reflect: the paper's
    /// accumulation texture. Call before the first step.
    void accumulate_at(std::span<const EyePoint> points);
    std::uint32_t batch() const { return batch_; }  ///< K
    /// [P] radiance reflected by the lobes toward the eye [cd/m²]; empty without an eye. Waits for
    /// the device.
    std::vector<glm::vec3> eye_radiance();

private:
    struct Kernels {
        Kernels(const gpu::Device& device, Projection projection);
        gpu::Kernel<shaders::GlossySelect> select;
        gpu::Kernel<shaders::GlossyReceive> receive;
        gpu::Kernel<shaders::GlossyEvaluate> evaluate;
    };

    /// Common start of frames: state of an iteration, and mean B, by which frames draw their
    /// shooters. Drawn by the last iteration's B, two frames would soon differ in all random
    /// choices.
    struct Held {
        gpu::Array<glm::vec3> emission, exitance, diffuse, near, last;
        gpu::Array<Eye> eyes;
        gpu::Array<glm::vec3> mean_exitance;
    };

    StochasticOptions phase_options() const;
    void begin();
    void begin_phases(const NearField& near, std::span<const glm::vec3> known,
                      std::span<const glm::vec3> first_emission);
    void go_on_in_phases(const std::vector<glm::vec3>& mean, float kept);
    std::vector<glm::vec3> mean_of_phases();
    void leave_phases();
    void rewind();
    void keep_average_of(const GlossyIllumination& before, float kept);
    std::vector<glm::vec3> mean_exitance();
    void draw_in_proportion_to(const gpu::Array<glm::vec3>& exitance, float by_area);
    bool has_two_choices() const;
    std::uint32_t area_shots() const;
    void select();
    void carry();
    void receive();
    void restart();
    void evaluate(gpu::Commands& commands);
    void take_figures();

    GlossyOptions options_;
    std::uint32_t count_;  ///< N lumels
    std::uint32_t batch_;  ///< K
    bool paper_;
    std::uint32_t atlas_width_;  ///< [texels]
    float near_radius_;
    float reflecting_area_;  ///< Σ A of lumels with albedo > 0 [m²]
    double emitted_power_;   ///< Σ A 𝓛(E) [lm]
    double known_sum_;       ///< given light [lx]

    const gpu::Device* device_;
    const World* world_;
    const Lumels* lumels_;
    const LobeParticles* particles_;  ///< null: shooters send lobes
    Kernels kernels_;
    std::optional<EyeViews> views_;  ///< empty in phases, which have their own
    gpu::Array<Eye> eyes_[2];        ///< this iteration's and the previous one's, alternating
    gpu::Array<GlossyShot> shots_;
    gpu::Array<GlossyLobe> lobes_;           ///< [K][kMaxLobes]
    gpu::Array<glm::vec4> surface_;          ///< ρ, A; A = 0 for buried lumels
    gpu::Array<Gloss> gloss_;                ///< [N]
    gpu::Array<float> albedo_table_;         ///< phong_albedo_table
    gpu::Array<glm::vec3> emission_;         ///< E
    gpu::Array<glm::vec3> exitance_;         ///< [N] B of the last iteration
    gpu::Array<glm::vec3> diffuse_;          ///< [N] its part that is equal in all directions
    gpu::Array<glm::vec3> near_;             ///< [N] near light of the previous B
    gpu::Array<glm::vec3> last_;             ///< [K][N] actual irradiance of the last iteration
    CarriedLight carried_;                   ///< by particles
    gpu::Array<glm::vec3> sums_, absorbed_;  ///< [2][N] since the last restart
    gpu::Array<glm::vec3> irradiance_;
    LumelSums figures_;
    std::optional<EyeImage> eye_;
    std::optional<Held> held_;  ///< since the first frame
    NearRows near_rows_;
    PowerPyramid power_;
    PowerPyramid area_power_;  ///< used with two choices only
    gpu::Pacer pacer_;         ///< its destructor waits for work that uses the members before it

    /// Until the first frame, with particles: shooters of diffuse light, and what particles add.
    std::optional<PhaseParticles> phase_particles_;
    std::optional<StochasticRadiosity> phases_;
    gpu::StageTimes times_of_phases_;  ///< once they are left
    mutable gpu::StageTimes times_;
    std::vector<glm::vec3> kept_;     ///< [N] [lx] average of the frame before, or empty
    float kept_weight_ = 0.0f;        ///< [iterations]
    double longest_of_phases_ = 0.0;  ///< [ms]

    SolverState state_;
    bool has_before_ = false;  ///< last_ holds the light of an earlier iteration's eyes_
    bool goes_on_ = false;     ///< continues from an earlier frame: light has spread already
    std::uint32_t iteration_ = 0, next_shot_ = 0;  ///< positions in the random sequences
    std::array<float, 2> batches_{};               ///< iterations in sums, per half
    std::uint64_t averaged_ = 0;                   ///< iterations in the average of this frame
};

}  // namespace lumel
