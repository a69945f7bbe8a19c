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
#include "raster/eyes/eye_views.h"
#include "raster/near/near_rows.h"
#include "solve/shooting/lumel_sums.h"
#include "solve/shooting/power_pyramid.h"
#include "solve/solver/solve_size.h"
#include "solve/solver/solver.h"

namespace lumel {

/// What goes in and out of a solution [lm], by luminance.
struct EnergyBalance {
    double emitted = 0.0;
    double absorbed = 0.0;
};

/// Shooters drawn by power send diffuse light and the lobes of their last irradiance.
class GlossyIllumination final : public Solver {
public:
    /// known: [N] [lx] of sky and lamps, or empty. particles: carry what lobes send on, that of
    /// `known` too, instead of the shooters; not with Scheme::paper. Must outlive this.
    /// first_emission: as SolverInputs has it; particles leave it too.
    GlossyIllumination(const gpu::Device& device, const World& world, const Lumels& lumels,
                       const NearField& near, const GlossyOptions& options,
                       std::span<const glm::vec3> known = {},
                       const LobeParticles* particles = nullptr,
                       std::span<const glm::vec3> first_emission = {});

    /// Bytes on the device at most, but for an eye, on one whose images may be as large as is
    /// wanted.
    static std::uint64_t device_bytes(const SolveSize& size, const GlossyOptions& options);

    void step() override;
    SolverState state() const override { return state_; }
    std::vector<glm::vec3> irradiance() override;
    const gpu::StageTimes& times() const override { return pacer_.times(); }
    double longest_submission() const override { return pacer_.longest_ms(); }

    /// Of the solution so far. Waits for the device.
    EnergyBalance energy();

    /// A frame of other light: E [N] [lm/m²] from now on. Every frame goes on from the iteration
    /// that the first one went on from, with the same random numbers and the same shooters; its
    /// average, and the eye's, start again. Where light moved far from where it was in the first
    /// frame, that is noisy: forget_frames() then. Waits for the device.
    void set_emission(std::span<const glm::vec3> emission);

    /// [N] 𝓛(B_j) / Φ [1/m²]: about the density with which shooters are drawn from now on. Waits
    /// for the device.
    std::vector<float> brightness();
    /// Lets the next frame be the first one. Waits for the device.
    void forget_frames();

    /// Before the first step, of a scene in which things have moved since the frame before, which
    /// has the same lumels and is wholly solved: the iteration starts from its light, and the
    /// average from its average, which counts as so many iterations. Without the latter frames with
    /// the same seed have much of their noise in common. Waits for the device.
    void go_on_from(GlossyIllumination& before, float kept = 0.0f);
    /// Iterations in the average since the last restart, without those of frames before.
    std::uint64_t averaged() const { return averaged_; }

    /// A frame for another eye: every step also adds to the image of one that sees these points.
    /// It goes on as any frame does, so that all eyes meet the same shooters and close ones see
    /// the same noise. Waits for the device.
    void look_at(std::span<const EyePoint> points, std::span<const float> brightness,
                 const EyeSampling& sampling);
    /// Before the first step: every step also adds to the image of an eye what shooters alone make
    /// these points reflect, the accumulation texture of the paper.
    void accumulate_at(std::span<const EyePoint> points);
    std::uint32_t batch() const { return batch_; }  ///< K
    /// [P] reflected by the lobes toward the eye [cd/m²]; empty without an eye. Waits for the
    /// device.
    std::vector<glm::vec3> eye_radiance();

private:
    struct Kernels {
        Kernels(const gpu::Device& device, Projection projection);
        gpu::Kernel<shaders::GlossySelect> select;
        gpu::Kernel<shaders::GlossyReceive> receive;
        gpu::Kernel<shaders::GlossyEvaluate> evaluate;
    };

    /// Where frames begin: what an iteration takes from the one before, and mean B, in proportion
    /// to which frames draw their shooters. Drawn by the last iteration's B, two frames would soon
    /// have nothing in common.
    struct Held {
        gpu::Array<glm::vec3> emission, exitance, diffuse, near, last;
        gpu::Array<Eye> eyes;
        gpu::Array<glm::vec3> mean_exitance;
    };

    void begin();
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
    double known_sum_;       ///< of light beside what is found here [lx]

    const gpu::Device* device_;
    const World* world_;
    const Lumels* lumels_;
    const LobeParticles* particles_;  ///< null: shooters send lobes
    Kernels kernels_;
    EyeViews views_;
    gpu::Array<Eye> eyes_[2];  ///< this iteration's and the one's before, by turns
    gpu::Array<GlossyShot> shots_;
    gpu::Array<GlossyLobe> lobes_;    ///< [K][kMaxLobes]
    gpu::Array<glm::vec4> surface_;   ///< ρ, A; A = 0 for buried lumels
    gpu::Array<Gloss> gloss_;         ///< [N]
    gpu::Array<float> albedo_table_;  ///< phong_albedo_table
    gpu::Array<glm::vec3> emission_;  ///< E
    gpu::Array<glm::vec3> exitance_;  ///< [N] B of the last iteration
    gpu::Array<glm::vec3> diffuse_;   ///< [N] the part of it that is the same in all directions
    gpu::Array<glm::vec3> near_;      ///< [N] near light of the B before it
    gpu::Array<glm::vec3> last_;      ///< [K][N] actual irradiance of the last iteration
    CarriedLight carried_;            ///< by particles
    gpu::Array<glm::vec3> sums_, absorbed_;  ///< [2][N] since the last restart
    gpu::Array<glm::vec3> irradiance_;
    LumelSums figures_;
    std::optional<EyeImage> eye_;
    std::optional<Held> held_;  ///< from the first frame on
    NearRows near_rows_;
    PowerPyramid power_;
    PowerPyramid area_power_;  ///< used with two choices only
    gpu::Pacer pacer_;         ///< after all that its work uses: it waits when it ends

    SolverState state_;
    bool has_before_ = false;  ///< last_ holds the light of eyes_ of an iteration before
    bool goes_on_ = false;     ///< from a frame before: light has spread already
    std::uint32_t iteration_ = 0, next_shot_ = 0;  ///< place in the random sequences
    std::array<float, 2> batches_{};               ///< iterations in sums, per half
    std::uint64_t averaged_ = 0;                   ///< of them, those of this frame
};

}  // namespace lumel
