#pragma once
// A lit scene whose light is a leaky mean along global directions: it follows whatever changes, at
// the same cost for every change, and lags behind.
//
//   [TN11] A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.

#include <optional>

#include "atlas/packing/atlas.h"
#include "methods/directions/directions.h"
#include "raster/shadow_maps/live_lamps.h"
#include "solve/solver/live_state.h"

namespace lumel {

struct LeakyOptions {
    AtlasOptions atlas;
    DirectionsOptions solver{.batch = 4};  ///< Scheme::paper, whatever it says
    double leak = 0.01;                    ///< share of the mean that a direction takes [TN11]
    std::vector<std::uint32_t> movers;     ///< instances that may move; empty: all
    bool still = false;                    ///< none may, whatever `movers` holds
    /// Of sun and lamps, found anew after each move. The sky is gathered along directions.
    DirectLightOptions lights{.sky_directions = 0, .sun_directions = 64, .disc_directions = 64};
    double residual = 0.002;  ///< share of the light before a change that is left, to rest at
};

/// Not safe for use from several threads.
class LeakyScene {
public:
    /// Lays the scene out and lifts it to lumels. The device must outlive it.
    /// Throws Error{input} if nothing of the scene can be lit, or a mover is no instance.
    LeakyScene(const gpu::Device& device, Scene scene, const LeakyOptions& options);

    /// As those of LiveScene. All take effect in update().
    void move(std::uint32_t instance, const glm::mat4& transform);
    void set_emission(std::uint32_t instance, const glm::vec3& factor);
    void set_reflectance(std::uint32_t instance, const glm::vec3& factor);
    void set_light(std::uint32_t light, const glm::vec3& factor);
    void set_sky(const glm::vec3& factor);

    /// Draws directions for about this number of milliseconds, one batch at least. Returns early
    /// when at rest: of the light before the last change less than options.residual is left. The
    /// noise of the last 1 / leak directions stays.
    LiveState update(double budget_ms);
    /// Until at rest.
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
    std::vector<glm::vec3> sky_;  ///< radiance of the sky as in the file
    std::vector<char> movers_;    ///< [instances]
    Atlas atlas_;
    Lumels lumels_;
    World world_;
    LiveLamps lamps_;
    GlobalDirections solver_;
    std::vector<std::optional<glm::mat4>> requested_;              ///< [instances]
    std::vector<glm::vec3> emission_factor_, reflectance_factor_;  ///< [instances]
    std::vector<glm::vec3> direct_;                                ///< [N] of sun and lamps
    LiveState state_;
    std::uint64_t changed_at_ = 0;  ///< directions drawn before the last change
    bool changed_ = false;          ///< emission, reflectance, lamps or sky
};

}  // namespace lumel
