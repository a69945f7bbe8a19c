#pragma once
// Interactive lighting: keeps irradiance up to date while lights, materials and objects change.
//
//     H = D + X,    X_i = 1/n Σ_k B[link_ik],    B = ρ H
//
// Every lumel traces n rays once and stores the lumel that each ray hits: a link. Dimming a light
// or changing an albedo takes sweeps over the links and no rays. Moving an object retraces the rays
// that start on it, ended on it or now hit it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "links/live/albedo_overrides.h"
#include "links/live/baked_light.h"
#include "links/live/display_filter.h"
#include "links/live/light_groups.h"
#include "links/live/lumel_links.h"
#include "links/live/lumel_sweeps.h"
#include "links/live/retrace_order.h"

namespace lumel {

struct LiveLinksOptions {
    std::uint32_t rays = 64;  ///< per lumel: 4, 16, 64 or 256
    GroupedLightOptions light;
    /// Names of movable objects: all instances of that name.
    std::vector<std::string> things;
    /// Further movable objects, by instance. Their numbers follow those of the names.
    std::vector<std::vector<std::uint32_t>> groups;
    std::uint32_t seed = 0;
    /// Convergence threshold for the relative residual of all lumels and of dark ones.
    double residual = 1e-4;
    bool filter = true;  ///< makes filter weights for shown()
};

/// As lay_out_movers(), for all instances of these names.
std::unique_ptr<SolveScene> lay_out(Scene scene, const AtlasOptions& options,
                                    const std::vector<std::string>& things);

/// Work done after moves.
struct Moved {
    Retraced links;
    double direct = 0.0;  ///< recomputed pairs of lumel and light group, relative to their number
};

struct LiveLinksState {
    /// Relative residual, estimated from the last sweeps: of all lumels and of dark ones.
    double residual = 1.0, dark_residual = 1.0;
    int sweeps = 0;                ///< since the last edit
    bool under_way = false;        ///< retracing or direct light is pending
    bool weighing = false;         ///< converged, but filter weights for shown() are pending
    bool at_rest = false;          ///< converged: advance() has no work left
    Moved found;                   ///< total over all moves
    std::uint64_t all_sweeps = 0;  ///< total
};

/// Lights a scene on the CPU and updates it after edits. Edit, call advance() once per frame, then
/// read shown() for display or irradiance() for the unfiltered solution. move() retraces before it
/// returns; request() leaves that to advance(), where direct light of the new position appears
/// first, all at once. Until the links are retraced, indirect light and the dim part of the sky
/// belong to the old position.
///
/// When state().at_rest, links and direct light equal those of a new LiveLinks of the edited scene
/// with the same seed, bit for bit; indirect light agrees within LiveLinksOptions::residual. Closed
/// rooms of albedo 0.99 take hundreds of sweeps. Not thread-safe.
class LiveLinks {
public:
    /// Traces all links and all direct light. Throws Error{input} if an object does not exist,
    /// nothing is static, or there is coloured glass.
    LiveLinks(std::unique_ptr<SolveScene> scene, const LiveLinksOptions& options);
    LiveLinks(const LiveLinks&) = delete;
    LiveLinks& operator=(const LiveLinks&) = delete;

    /// Scales the emission of all lights, or of a material's surfaces, of that name to `factor` ×
    /// its value in the scene. Throws Error{input} if there is none, or if a factor is negative.
    void set_lamp(const std::string& name, const glm::vec3& factor);
    /// Scale one light, or the surfaces of one material, by index.
    void set_light(std::uint32_t light, const glm::vec3& factor);
    void set_emission(std::uint32_t material, const glm::vec3& factor);
    /// Scales the sky.
    void set_sky(const glm::vec3& factor);
    /// Rotates the given sky by an angle [rad] about +y, counter-clockwise seen from above.
    /// Retraces shadow rays to its bright parts only.
    void turn_sky(double angle);
    void replace_sky(Sky sky, double angle);
    /// Sets a material's base colour, 0 to 1, which is multiplied by its texture. The first call
    /// for a material is slower. Throws Error{input} if there is no such material.
    void set_albedo(const std::string& material, const glm::vec3& colour);
    void set_albedo(std::uint32_t material, const glm::vec3& colour);
    /// Moves all lights of that name (light to world).
    void move_lamp(const std::string& name, const glm::mat4& transform);
    void move_light(std::uint32_t light, const glm::mat4& transform);
    /// Moves an object by `motion` from its position in the scene (world to world). Throws
    /// Error{input} if it is not one of the options' objects, or `motion` is not rigid.
    Moved move(const std::string& thing, const glm::mat4& motion);
    /// Schedules a move for advance(). A later request for the object replaces it.
    void request(std::uint32_t thing, const glm::mat4& motion);

    /// Works for about `budget_ms`, or until converged: first pending moves, then sweeps. Exceeds
    /// the budget by a few milliseconds at most; runs at least part of a sweep.
    LiveLinksState advance(double budget_ms);
    /// Works until converged.
    LiveLinksState settle();

    const LiveLinksState& state() const { return state_; }
    /// H [N] [lx]
    std::vector<glm::vec3> irradiance() const;
    /// Irradiance for display [N] [lx]: light gathered by rays is filtered
    /// (links/live/display_filter.h) with the weights of the last converged solution. Takes as long
    /// as part of a sweep. Baked light, if there is any.
    std::vector<glm::vec3> shown() const;
    /// Lumels for a map of shown().
    Lumels shown_lumels() const;

    /// The scene with all edits but moves that are requested and not made, for bake_standing().
    StandingScene standing() const;
    /// Displays light of standing() until the next edit.
    void show(BakedLight light) { baked_ = std::move(light); }
    /// Null: light of links is displayed.
    const BakedLight* baked() const { return baked_ ? &*baked_ : nullptr; }

    /// [N] Estimated relative error of shown(), 0…1: filtered ray noise plus residual. Excludes
    /// noise of shadow rays and the filter's bias. 1 until light has first converged. That of
    /// baked light, if there is any.
    std::vector<float> error_estimate() const;

    const SolveScene& solve_scene() const { return *scene_; }
    const Scene& scene() const { return scene_->scene; }
    const Atlas& atlas() const { return scene_->atlas; }
    const Lumels& lumels() const { return scene_->lumels; }
    const LumelLinks& links() const { return links_; }
    /// ρ [N], with albedo overrides.
    const std::vector<glm::vec3>& albedo() const { return paint_.albedo(); }
    /// Memory of links and light [bytes], without scene and BVHs.
    std::uint64_t bytes() const;
    /// D [N] [lx], including the sky light of the links.
    std::vector<glm::vec3> direct();

private:
    using Part = LightSources::Part;
    /// A moved object, and the number of lumels already updated.
    struct PendingMove {
        std::uint32_t thing;
        Box before;              ///< its bounds when direct light was last complete
        std::size_t direct = 0;  ///< number of lumels with updated direct light
        RetraceOrder order;      ///< order in which links are retraced
        std::size_t links = 0;   ///< number of lumels of `order` that are retraced
    };

    LinkContext place() const;
    void note_edit();
    std::uint32_t thing(const std::string& name) const;
    void put(std::uint32_t thing, const glm::mat4& motion);
    bool is_requested() const;
    void put_requested();
    void place_sky(double angle);
    bool is_under_way() const;
    static bool has_near_to_follow(const PendingMove& one);
    PendingMove* with_direct();
    void follow_direct(PendingMove& one);
    void follow_links();
    void work();
    void begin();
    void sweep();
    bool is_at_rest();

    LiveLinksOptions options_;
    std::unique_ptr<SolveScene> scene_;
    std::vector<glm::mat4> given_;  ///< [instances] transforms of the given scene
    DynamicRayScene rays_;
    WorldLumels world_;
    RayOrigins starts_;
    Sky given_sky_;
    LightSources sources_;
    std::vector<std::vector<std::uint32_t>> lumels_of_;  ///< [things] lumels on each
    LumelLinks links_;
    LightGroups light_;
    LumelSweeps sweeps_;
    AlbedoOverrides paint_;
    DisplayFilter filter_;
    glm::vec3 sky_factor_{1.0f};
    std::vector<glm::vec3> sky_light_;  ///< [N] [lx] sky light when the sweeps began; empty: no sky
    std::vector<glm::mat4> motions_;    ///< [things] relative to the given scene
    std::vector<std::optional<glm::mat4>> requested_;  ///< [things] motions
    std::vector<PendingMove> following_;
    std::uint64_t unseen_ = 0;         ///< links retraced since the last sweep began
    bool edited_ = true;               ///< since the last sweep
    bool swept_ = true;                ///< a complete sweep has run since the last edit
    bool weighing_ = false;            ///< light has converged, filter weights have not
    std::optional<BakedLight> baked_;  ///< of the present scene
    LiveLinksState state_;
};

}  // namespace lumel
