#pragma once
// Interactive light as a leaky average along global directions: it follows any change at the same
// cost, with a lag.
//
//   [TN11] A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.

#include <optional>

#include "atlas/packing/atlas.h"
#include "methods/directions/directions.h"
#include "raster/shadow_maps/live_lamps.h"
#include "solve/solver/instance_edits.h"
#include "solve/solver/live_state.h"

namespace lumel {

struct LeakyOptions {
    AtlasOptions atlas;
    DirectionsOptions solver{.batch = 4};  ///< always uses Scheme::paper
    double leak = 0.01;                    ///< fraction that a direction replaces [TN11]
    std::vector<std::uint32_t> movers;     ///< movable instances; empty: all
    bool still = false;                    ///< true: none is movable, `movers` is ignored
    /// Sun and lamps, recomputed after each move. The sky is gathered along directions.
    DirectLightOptions lights{.sky_directions = 0, .sun_directions = 64, .disc_directions = 64};
    double residual = 0.002;  ///< converged below this fraction of the light before a change
};

/// Not thread-safe.
class LeakyScene {
public:
    /// Builds atlas and lumels of the scene. The device must outlive this. Throws Error{input} if
    /// the scene has no lumels, or a mover is not an instance.
    LeakyScene(const gpu::Device& device, Scene scene, const LeakyOptions& options);

    /// As in LiveScene. All take effect in update().
    void move(std::uint32_t instance, const glm::mat4& transform);
    void set_emission(std::uint32_t instance, const glm::vec3& factor);
    void set_reflectance(std::uint32_t instance, const glm::vec3& factor);
    void set_light(std::uint32_t light, const glm::vec3& factor);
    void set_sky(const glm::vec3& factor);

    /// Processes directions for about `budget_ms`, one batch at least. Returns early when
    /// converged: less than options.residual of the light before the last change is left. The
    /// noise of the last 1 / leak directions stays.
    LiveState update(double budget_ms);
    /// Works until converged.
    LiveState settle();

    /// H [N] [lx]. Waits for the device.
    std::vector<glm::vec3> irradiance();

    const Scene& scene() const { return scene_; }
    const Atlas& atlas() const { return atlas_; }
    const Lumels& lumels() const { return lumels_; }
    const gpu::StageTimes& times() const { return solver_.times(); }

private:
    bool place_what_moved();
    void begin_anew();

    const gpu::Device* device_;
    LeakyOptions options_;
    Scene scene_;
    std::vector<glm::vec3> sky_;  ///< radiance of the sky in the file
    InstanceEdits edits_;
    Atlas atlas_;
    Lumels lumels_;
    World world_;
    LiveLamps lamps_;
    GlobalDirections solver_;
    std::vector<glm::vec3> direct_;  ///< [N] light of sun and lamps
    LiveState state_;
    std::uint64_t changed_at_ = 0;  ///< directions drawn before the last change
    bool changed_ = false;          ///< emission, reflectance, lamps or sky
};

}  // namespace lumel
