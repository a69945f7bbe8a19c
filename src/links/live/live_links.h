#pragma once
// A lit scene that is edited while it is seen: light over links that are kept.

#include <optional>
#include <string>
#include <vector>

#include "links/live/albedo_overrides.h"
#include "links/live/display_filter.h"
#include "links/live/light_groups.h"
#include "links/live/lumel_links.h"
#include "links/live/lumel_sweeps.h"
#include "links/live/retrace_order.h"

namespace lumel {

struct LiveLinksOptions {
    std::uint32_t rays = 64;  ///< of a lumel: 4, 16, 64 or 256
    GroupedLightOptions light;
    /// Names of what may move: of all instances of that name.
    std::vector<std::string> things;
    /// What else may move: instances that move together. Their numbers follow those of the names.
    std::vector<std::vector<std::uint32_t>> groups;
    std::uint32_t seed = 0;
    /// Light still to come, as a part of all and of dark lumels' own, to rest at.
    double residual = 1e-4;
    bool filter = true;  ///< makes weights for shown()
};

/// A scene with its lumels.
struct LumelScene {
    Scene scene;
    Atlas atlas;
    Lumels lumels;
};

/// Lays a scene out. What lies under or in what stays is buried. Throws Error.
LumelScene lay_out(Scene scene, const AtlasOptions& options,
                   const std::vector<std::string>& things);
/// The same by instances.
LumelScene lay_out_movers(Scene scene, const AtlasOptions& options,
                          const std::vector<std::uint32_t>& movers);

/// What moves have found again.
struct Moved {
    Retraced links;
    double direct = 0.0;  ///< share of direct light: of lumels, each for each group
};

struct LiveLinksState {
    /// Light still to come, as far as the last sweeps tell: of all lumels by their mean, and of
    /// dark ones by theirs.
    double residual = 1.0, dark_residual = 1.0;
    int sweeps = 0;                ///< since the last edit
    bool under_way = false;        ///< links or direct light do not know all requests yet
    bool weighing = false;         ///< light is at rest, and the weights of shown() are being made
    bool at_rest = false;          ///< advance() has nothing left to do
    Moved found;                   ///< again for all moves, from the beginning on
    std::uint64_t all_sweeps = 0;  ///< from the beginning on
};

/// Every lumel has traced its rays once, and what they met is kept. So a lamp that is dimmed or a
/// wall that is painted takes no ray: light that arrives straight from each sender is kept apart,
/// and a few sweeps over the links bring all bounces. When a thing moves only the rays that it
/// starts, ends or stops are traced again.
///
/// At rest the light is that of a scene that is solved anew with the same seed: links and direct
/// light in every bit, what bounces within the residual. Works on the host; not safe for use from
/// several threads. Closed rooms of albedo 0.99 take hundreds of sweeps.
///
/// move() traces at once. request() leaves that to advance(), within its budget. Light that arrives
/// straight from senders is found first, and shown when it is whole; until the links have followed
/// too, what bounces, and the sky but for its bright part, is that of the places before.
class LiveLinks {
public:
    /// Traces all links, and finds all direct light. Throws Error{input} for things that the scene
    /// does not have, for scenes of which nothing stays, and for coloured glass.
    LiveLinks(LumelScene laid_out, const LiveLinksOptions& options);
    LiveLinks(const LiveLinks&) = delete;
    LiveLinks& operator=(const LiveLinks&) = delete;

    /// What lights of that name, or surfaces of a material of that name, send is `factor` times
    /// their value in the scene. Throws Error{input} if there is none, or a factor is negative.
    void set_lamp(const std::string& name, const glm::vec3& factor);
    /// The same of one light, or of the surfaces of one material, by their indices.
    void set_light(std::uint32_t light, const glm::vec3& factor);
    void set_emission(std::uint32_t material, const glm::vec3& factor);
    /// The same of the sky.
    void set_sky(const glm::vec3& factor);
    /// The sky of the scene, turned about +y, counter-clockwise as seen from above, by an angle
    /// [rad] from how it was given. No ray is traced again but those to its bright parts.
    void turn_sky(double angle);
    /// Another sky, turned so, stands in place of the one of the scene.
    void replace_sky(Sky sky, double angle);
    /// A material reflects with this base colour, 0 to 1, times its texture. The first time for
    /// each material takes longer. Throws Error{input} if there is no such material.
    void set_albedo(const std::string& material, const glm::vec3& colour);
    void set_albedo(std::uint32_t material, const glm::vec3& colour);
    /// Lights of that name shine from elsewhere (light to world).
    void move_lamp(const std::string& name, const glm::mat4& transform);
    void move_light(std::uint32_t light, const glm::mat4& transform);
    /// A thing stands where `motion` takes it from its place in the scene (world to world).
    /// Throws Error{input} if it is no thing of the options, or would be stretched.
    Moved move(const std::string& thing, const glm::mat4& motion);
    /// The same, in advance(). Of several requests for a thing the last counts.
    void request(std::uint32_t thing, const glm::mat4& motion);

    /// Works for about so many milliseconds, or until at rest: follows what was requested, then
    /// sweeps. Longer by a few milliseconds at most; a part of a sweep at least.
    LiveLinksState advance(double budget_ms);
    /// Until at rest.
    LiveLinksState settle();

    const LiveLinksState& state() const { return state_; }
    /// H [N] [lx]
    std::vector<glm::vec3> irradiance() const;
    /// The same for the eye: what rays bring is filtered (links/live/display_filter.h) by weights
    /// of the last light that was at rest. Takes as long as a part of a sweep.
    std::vector<glm::vec3> shown() const;

    /// [N] What is not settled of shown(), by its size, 0…1: the noise of its rays as the filter
    /// leaves it, as far as two halves of them tell, and light still to come. Not in it: what few
    /// rays to a lamp or the filter itself get wrong. 1 before light was at rest for the first
    /// time.
    std::vector<float> error_estimate() const;

    const Scene& scene() const { return laid_out_.scene; }
    const Atlas& atlas() const { return laid_out_.atlas; }
    const Lumels& lumels() const { return laid_out_.lumels; }
    const LumelLinks& links() const { return links_; }
    /// ρ [N], with what was painted.
    const std::vector<glm::vec3>& albedo() const { return paint_.albedo(); }
    /// Memory that links and light take, without what the scene and its rays do.
    std::uint64_t bytes() const;
    /// D [N] [lx], what rays bring from the sky included.
    std::vector<glm::vec3> direct();

private:
    using Part = LightSources::Part;
    /// A thing that has moved, and how many lumels know.
    struct PendingMove {
        std::uint32_t thing;
        Box before;              ///< where it was when direct light last was whole
        std::size_t direct = 0;  ///< lumels
        RetraceOrder order;      ///< in which links follow
        std::size_t links = 0;   ///< lumels of it
    };

    float extent() const;
    LinkContext place() const;
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
    LumelScene laid_out_;
    std::vector<glm::mat4> given_;  ///< [instances] transforms of the scene that was given
    DynamicRayScene rays_;
    Surfaces surfaces_;
    WorldLumels world_;
    RayOrigins starts_;
    Sky given_sky_;
    std::optional<LightSources> sources_;  ///< always; made anew where it is for another sky
    std::vector<std::vector<std::uint32_t>> lumels_of_;  ///< [things] lumels on each
    LumelLinks links_;
    LightGroups light_;
    LumelSweeps sweeps_;
    AlbedoOverrides paint_;
    DisplayFilter filter_;
    glm::vec3 sky_factor_{1.0f};
    std::vector<glm::vec3> sky_light_;  ///< [N] [lx] of it when the sweeps began; empty: no sky
    std::vector<glm::mat4> motions_;    ///< [things] from where they were given
    std::vector<std::optional<glm::mat4>> requested_;  ///< [things] motions
    std::vector<PendingMove> following_;
    std::uint64_t unseen_ = 0;  ///< links traced again since the last sweep began
    bool edited_ = true;        ///< since the last sweep
    bool swept_ = true;         ///< wholly, since the last edit
    bool weighing_ = false;     ///< light is at rest, but not the filter's weights
    LiveLinksState state_;
};

}  // namespace lumel
