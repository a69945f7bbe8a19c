#pragma once
// Interactive radiosity with moving objects: the solution is corrected, not solved again.
//
//   [Hoef13] M. van de Hoef. Real-Time Dynamic Radiosity for High Quality Global Illumination.
//            Utrecht University, 2013.

#include <array>
#include <optional>

#include "atlas/near/moving_near_field.h"
#include "atlas/packing/atlas.h"
#include "methods/options.h"
#include "methods/progressive/visibility_rows.h"
#include "methods/redistribution/cross.h"
#include "methods/redistribution/incremental.h"
#include "methods/redistribution/live.show.comp.h"
#include "methods/redistribution/paper_cross.h"
#include "methods/redistribution/paper_incremental.h"
#include "methods/redistribution/remaining_light.h"
#include "raster/shadow_maps/live_lamps.h"
#include "solve/solver/instance_edits.h"
#include "solve/solver/live_state.h"

namespace lumel {

/// Method of redistribution after a move.
enum class Redistribution {
    incremental,  ///< exact: all patches that shot render views of moved objects
    cross,        ///< only movable patches render views: much faster for small objects
    // As in [Hoef13]:
    paper_incremental,        ///< merged with a progressive iteration of all static patches
    paper_cross,              ///< lamps are crossed as well: undersamples small ones
    paper_cross_incremental,  ///< the incremental cross projection: errors accumulate
};

/// True if only movable patches render views.
inline bool crosses(Redistribution redistribution)
{
    return redistribution != Redistribution::incremental &&
           redistribution != Redistribution::paper_incremental;
}

struct LiveOptions {
    AtlasOptions atlas;
    Redistribution redistribution = Redistribution::incremental;
    CrossOptions cross;
    bool reprojects = true;  ///< false: paper_cross without Reproject, [Hoef13] figure 4.5.3
    ProgressiveOptions solver;
    double target_error = SolverOptions{}.target_error;  ///< for the near field only
    std::vector<std::uint32_t> movers;                   ///< movable instances; empty: all
    bool still = false;                                  ///< true: none, `movers` is ignored
    /// Direct light of sky, sun and lamps, recomputed after each move, a few views at a time.
    DirectLightOptions lights{.sky_directions = 256, .sun_directions = 64, .disc_directions = 64};
    double residual = 0.0005;  ///< converged below this relative unshot light
    /// Memory for stored visibility of patches, which saves rendering; 0: none, as in the thesis.
    std::uint64_t visibility_bytes = std::uint64_t(256) << 20;
};

/// Not thread-safe.
class LiveScene {
public:
    /// Builds atlas and lumels of the scene. The device must outlive this. Throws Error{input} if
    /// the scene has no lumels, or a mover is not an instance.
    LiveScene(const gpu::Device& device, Scene scene, const LiveOptions& options);

    /// Requests a new transform of an instance (mesh to world), for update(); the last request
    /// before it counts. Throws Error{input} if the instance is not movable, or would be stretched:
    /// lumels keep their areas.
    void move(std::uint32_t instance, const glm::mat4& transform);

    /// Scales emission [lm/m²] or reflectance of all lumels of an instance relative to the scene
    /// ([Hoef13] Eqs. (2.2.9), (2.2.10)). Clamps reflectances to 0…1. Throws Error{input} if there
    /// is no such instance or a factor is negative.
    void set_emission(std::uint32_t instance, const glm::vec3& factor);
    void set_reflectance(std::uint32_t instance, const glm::vec3& factor);

    /// Scales a light of Scene::lights, or the sky, relative to the scene. Throws Error{input} if
    /// there is no such light, no sky, or a factor is negative.
    void set_light(std::uint32_t light, const glm::vec3& factor);
    void set_sky(const glm::vec3& factor);

    /// Works for about `budget_ms`: on moves first, then on unshot light; at least one batch,
    /// exceeding the budget by at most one. Returns early when converged.
    LiveState update(double budget_ms);
    /// Works until converged.
    LiveState settle();

    /// Status after the last update().
    const LiveState& state() const { return state_; }
    /// H [N] [lx] after the last completely redistributed move. Waits for the device.
    std::vector<glm::vec3> irradiance() const;

    /// irradiance() as texels of the atlas, front sides: RGB = H [lx], A = 1 where there is a
    /// lumel; rgba32, in the general layout, complete when update() returns. Each update() that
    /// changes it draws into the other of two images, so that the previous one can still be read.
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
    bool is_at_rest() const;
    bool is_crossed() const;
    bool begin_incremental();
    template <class Scene, class Call>
    static auto of_redistribution(Scene& scene, const Call& call);

    const gpu::Device* device_;
    LiveOptions options_;
    Scene scene_;
    InstanceEdits edits_;
    Atlas atlas_;
    Lumels lumels_;
    RayScene rays_;
    NearField still_near_;  ///< if crosses(): of static pairs
    MovingNearField near_;  ///< for all pairs; with Redistribution::cross: for pairs with movers
    World world_;
    LiveLamps lamps_;
    ProgressiveRadiosity solver_;
    VisibilityRows rows_;  ///< if crosses(): for the world without movers
    RemainingLight remaining_;
    std::optional<IncrementalRedistribution> incremental_;
    std::optional<PaperIncremental> paper_incremental_;
    std::optional<CrossRedistribution> cross_;
    std::optional<PaperCross> paper_cross_;
    Move move_;  ///< current one
    LiveState state_;
    int batches_ = 0;            ///< since the last readback of the residual
    bool corrects_ = false;      ///< the unshot light was left by a redistribution
    bool crossed_ = false;       ///< the movers' effect is known for all but uncrossed_
    double uncrossed_ = 0.0;     ///< light shot since, relative to all light
    double moving_share_ = 0.0;  ///< area of movers relative to all surfaces
    bool knows_crossing_pairs_ = false;
    bool surfaces_changed_ = false;  ///< emission, reflectance or lamps, since the last update()
    gpu::Array<glm::vec3> direct_;   ///< [N] H of sky, sun and lamps
    gpu::Array<glm::vec3> shown_;    ///< [N] H after the last complete move
    gpu::Array<glm::vec4> texels_;   ///< [height][width] of the image
    std::array<gpu::Target, 2> images_;
    std::size_t shown_image_ = 0;
    bool unseen_ = false;  ///< a move has ended since show()
    gpu::Kernel<shaders::LiveShow> show_;
};

}  // namespace lumel
