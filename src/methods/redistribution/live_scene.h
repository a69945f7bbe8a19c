#pragma once
// A lit scene in which things move: the solution is corrected, not solved again.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013.

#include <array>
#include <optional>

#include "atlas/near/moving_near_field.h"
#include "atlas/packing/atlas.h"
#include "methods/options.h"
#include "methods/redistribution/cross.h"
#include "methods/redistribution/incremental.h"
#include "methods/redistribution/live.show.comp.h"
#include "methods/redistribution/remaining_light.h"
#include "methods/redistribution/visibility_rows.h"
#include "raster/shadow_maps/live_lamps.h"
#include "solve/solver/live_state.h"

namespace lumel {

/// How a move is redistributed.
enum class Redistribution {
    incremental,  ///< exact: every patch that shot looks at what moved
    cross,        ///< only what moves looks: much faster where it is small
};

struct LiveOptions {
    AtlasOptions atlas;
    Redistribution redistribution = Redistribution::incremental;
    ProgressiveOptions solver;
    double target_error = SolverOptions{}.target_error;  ///< of the near field alone
    std::vector<std::uint32_t> movers;                   ///< instances that may move; empty: all
    bool still = false;                                  ///< none may, whatever `movers` holds
    /// Of sky, sun and lamps: their direct light is found anew after each move, a few views at a
    /// time.
    DirectLightOptions lights{.sky_directions = 256, .sun_directions = 64, .disc_directions = 64};
    double residual = 0.0005;  ///< light still to be shot, as a part of all, to rest at
    /// Kept of what patches see, so that it is not rendered again; 0: nothing, as in the thesis.
    std::uint64_t visibility_bytes = std::uint64_t(256) << 20;
};

/// Not safe for use from several threads.
class LiveScene {
public:
    /// Lays the scene out and lifts it to lumels. The device must outlive it.
    /// Throws Error{input} if nothing of the scene can be lit, or a mover is no instance.
    LiveScene(const gpu::Device& device, Scene scene, const LiveOptions& options);

    /// Asks for an instance to stand elsewhere (mesh to world). Takes effect in update(); of
    /// several requests before it, the last counts.
    /// Throws Error{input} if it may not move, or would be stretched: lumels keep their areas.
    void move(std::uint32_t instance, const glm::mat4& transform);

    /// All lumels of an instance emit [lm/m²], or reflect, `factor` times their value in the scene
    /// ([Hoef13] Eqs. (2.2.9), (2.2.10)). Reflectances are kept from 0 to 1.
    /// Throws Error{input} if there is no such instance or a factor is negative.
    void set_emission(std::uint32_t instance, const glm::vec3& factor);
    void set_reflectance(std::uint32_t instance, const glm::vec3& factor);

    /// What a light of Scene::lights, or the sky, sends is `factor` times its value in the scene.
    /// Throws Error{input} if there is no such light, no sky, or a factor is negative.
    void set_light(std::uint32_t light, const glm::vec3& factor);
    void set_sky(const glm::vec3& factor);

    /// Works for about this number of milliseconds: on moves first, then on light that is not shot
    /// yet; one batch at least, and overruns by one batch at most. Returns early when at rest.
    LiveState update(double budget_ms);
    /// Until at rest.
    LiveState settle();

    /// As the last update() left it.
    const LiveState& state() const { return state_; }
    /// H [N] [lx] after the last move that is wholly redistributed. Waits for the device.
    std::vector<glm::vec3> irradiance() const;

    /// The same as texels of the atlas, front sides: RGB = H [lx], A = 1 where there is a lumel;
    /// rgba32, in the general layout, whole when update() returns. Each update() that changes it
    /// draws into the other of two images, so that a host may still read the one before.
    const gpu::Target& irradiance_image() const { return images_[shown_image_]; }

    const Scene& scene() const { return scene_; }
    const Atlas& atlas() const { return atlas_; }
    const Lumels& lumels() const { return lumels_; }
    const World& world() const { return world_; }
    const gpu::StageTimes& times() const { return solver_.times(); }

private:
    void work();
    void begin_move();
    void end_move();
    void follow_move();
    void shoot();
    void show();
    void upload_surfaces();
    void begin_lamps();
    void settle_move();
    void light_changes();
    bool is_under_way() const;
    bool is_redistributing() const;
    bool is_move_requested() const;
    bool is_at_rest() const;
    bool is_crossed() const;
    void set_factor(std::vector<glm::vec3>& factors, std::uint32_t instance,
                    const glm::vec3& factor);

    const gpu::Device* device_;
    LiveOptions options_;
    Scene scene_;
    std::vector<char> movers_;  ///< [instances]
    Atlas atlas_;
    Lumels lumels_;
    RayScene rays_;
    NearField still_near_;  ///< with Redistribution::cross: among what stays
    MovingNearField near_;  ///< of all pairs; with Redistribution::cross: of those that move
    World world_;
    LiveLamps lamps_;
    ProgressiveRadiosity solver_;
    VisibilityRows rows_;  ///< with Redistribution::cross: without movers
    RemainingLight remaining_;
    std::optional<IncrementalRedistribution> incremental_;
    std::optional<CrossRedistribution> cross_;
    std::vector<std::optional<glm::mat4>> requested_;  ///< [instances] transforms requested
    std::vector<glm::vec3> emission_factor_, reflectance_factor_;  ///< [instances]
    Move move_;                                                    ///< under way
    LiveState state_;
    int batches_ = 0;            ///< shot since the last look at how much light is still to be shot
    bool corrects_ = false;      ///< what is unshot was left by a redistribution
    bool crossed_ = false;       ///< what movers do is known for all that is shot, less uncrossed_
    double uncrossed_ = 0.0;     ///< shot since, as a part of all light
    double moving_share_ = 0.0;  ///< of the area of all surfaces
    bool knows_crossing_pairs_ = false;
    bool surfaces_changed_ = false;  ///< emission, reflectance or lamps, since the last update()
    gpu::Array<glm::vec3> direct_;   ///< [N] H of sky, sun and lamps
    gpu::Array<glm::vec3> shown_;    ///< [N] H after the last whole move
    gpu::Array<glm::vec4> texels_;   ///< [height][width] of the image
    std::array<gpu::Target, 2> images_;
    std::size_t shown_image_ = 0;
    bool unseen_ = false;  ///< a move has ended since show()
    gpu::Kernel<shaders::LiveShow> show_;
};

}  // namespace lumel
