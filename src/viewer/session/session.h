#pragma once
// Interactive session with a lit scene: view, pick, move, dim; light is updated by frames.

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "atlas/cells/near_lumels.h"
#include "base/images/false_colour.h"
#include "base/json/json_view.h"
#include "jobs/play/links_light.h"
#include "links/live/live_links.h"
#include "results/preview/preview.h"
#include "scene/sky/light_options.h"
#include "scene/values/animation.h"
#include "viewer/session/camera.h"
#include "viewer/session/probe_balls.h"
#include "viewer/session/solved.h"
#include "viewer/session/things.h"

namespace lumel {

struct SessionOptions {
    LightOptions lights;
    AtlasOptions atlas;
    std::string device;  ///< index or part of a name as `lumel devices` lists; empty: best
    std::uint32_t link_rays = LiveLinksOptions{}.rays;  ///< per lumel
    std::uint32_t seed = 1;
    bool filter = true;
    double residual = LiveLinksOptions{}.residual;
    /// Light at rest is baked to this estimated relative error; 0: it remains that of links.
    double bake_error = SolverOptions{}.target_error;
    double budget_ms = 15.0;              ///< for light, per frame
    int camera = -1;                      ///< index in the file; -1: the first, or a generated one
    int width = 640;                      ///< width of images [pixels]
    std::size_t animation = 0;            ///< index into the file's animations
    std::vector<std::string> movable;     ///< names of movable objects; empty: small ones
    std::optional<SolverOptions> solver;  ///< first solver of the scene; empty: links
};

enum class ViewMode {
    lit,
    irradiance,  ///< irradiance in false colours
    lumels,      ///< a colour for each chart, lumels as a checkerboard
    links,       ///< contributors to a lumel's light, as lines
    error,       ///< estimated error in false colours
};
/// Their names, in order.
inline constexpr std::array<const char*, 5> kViewModes{"lit", "irradiance", "lumels", "links",
                                                       "error"};

/// Surface under a pixel.
struct Picked {
    std::uint32_t instance = 0;
    int material = 0;
    std::uint32_t lumel = kNoLumel;
    std::optional<std::uint32_t> thing;  ///< empty: static
    glm::vec3 place{0.0f}, normal{0.0f};
    float distance = 0.0f;  ///< distance from the eye [m]
};

/// A light or an emissive material.
struct ViewLamp {
    std::string name;
    bool is_light = false;
    std::uint32_t index = 0;  ///< index into the scene's lights or materials
    glm::vec3 factor{1.0f};   ///< user's factor
};

/// End of a lumel's link.
struct ViewLink {
    std::string name;       ///< instance name, "sky", or empty: absorbed
    glm::vec3 to{0.0f};     ///< its position; sky: a diagonal of the scene away [m]
    glm::vec3 light{0.0f};  ///< light along it, emission included [lx]
};

/// Wall-clock times of frames or images.
struct FrameCosts {
    int frames = 0;
    double last_ms = 0.0, most_ms = 0.0, all_ms = 0.0;

    void add(double ms);
};

/// The atlas is built once; LiveLinks follows all edits, within a time budget per frame. Functions
/// that name an object not in the scene throw Error{input} and change nothing.
class ViewSession {
public:
    /// scene: with all its lights. animation: of its file, or empty. Traces all links. The device
    /// must outlive this.
    ViewSession(const gpu::Device& device, Scene scene, Animation animation,
                const SessionOptions& options);
    ViewSession(const ViewSession&) = delete;
    ViewSession& operator=(const ViewSession&) = delete;

    /// Replays the edits of another session of the same scene and animation, with its view
    /// settings. Nothing is picked.
    void take_edits(const ViewSession& before);

    ViewCamera& camera() { return camera_; }
    const ViewCamera& camera() const { return camera_; }
    /// Uses a camera of the file.
    void take_camera(int index);
    /// Orbits the picked object, or the surface at the image's centre [rad].
    void orbit(float around, float over);

    std::optional<Picked> seen_at(const glm::ivec2& pixel);
    /// Picks the surface at a pixel; unpicks if there is none.
    void pick(const glm::ivec2& pixel);
    /// Picks the first instance of that name.
    void pick(const std::string& name);
    void unpick();
    const std::optional<Picked>& picked() const { return picked_; }
    const std::optional<glm::ivec2>& pixel() const { return pixel_; }

    /// Shows links of the lumel under this pixel instead of the picked one.
    void probe(const glm::ivec2& pixel);
    /// The links of that lumel; empty without one. Light sources sampled by shadow rays have no
    /// links: the bright sky, and lamps that are not surfaces.
    std::vector<ViewLink> links();

    // Require that a movable object is picked.
    void move(const glm::vec3& way);  ///< [m]
    void turn(float angle);           ///< about +y through its centre [rad]
    void remove();

    void set_lamp(const std::string& name, const glm::vec3& factor);
    /// Requires that an emissive surface is picked.
    void dim(const glm::vec3& factor);
    /// Base colour of the picked surface, 0 to 1.
    void paint(const glm::vec3& colour);
    void set_sky(const glm::vec3& factor);
    const glm::vec3& sky() const { return sky_; }
    void turn_sky(double angle);  ///< [rad] counter-clockwise, relative to the given sky
    /// Moves the options' sun, or else the first directional light. It is off below the horizon.
    void set_sun(const SunPosition& sun);
    void set_time(double seconds);

    void set_exposure(std::optional<float> factor) { exposure_ = factor; }  ///< empty: automatic
    /// Automatic, or fixed at the current value.
    void set_automatic_exposure(bool automatic);
    void step_exposure(float stops) { stops_ += stops; }
    void set_mode(ViewMode mode) { mode_ = mode; }

    /// Shows light probes as balls, on a grid of this spacing [m] and where the file names them, in
    /// ViewMode::lit and irradiance. 0: none. Their positions stay fixed. Throws Error{input} if
    /// there are too many.
    void set_probes(double spacing);
    double probe_spacing() const { return probe_spacing_; }
    /// For the last converged displayed light; empty before.
    const std::vector<ProbeBall>& probe_balls();

    /// The current scene, with its materials read by that model. Throws Error.
    StandingScene standing(MaterialModel model) const;
    std::uint64_t edits() const { return edits_; }  ///< number of edits of the scene
    /// Displays light that was solved after this number of edits. Returns false, without taking it,
    /// if there are more.
    bool take_solved(SolvedLight light, std::uint64_t edits);
    /// Displays the solved light of the current scene, or else the light of links. Throws
    /// Error{input} if there is none.
    void show_solved(bool solved);
    /// Solved light of the current scene; null: none.
    const SolvedLight* solved() const { return solved_ ? &*solved_ : nullptr; }
    /// True if it is displayed instead of the light of links; never in ViewMode::links.
    bool shows_solved() const;

    /// Scale of the false colours of this mode; empty: automatic.
    void set_scale(const std::optional<LuxScale>& scale);

    /// Sets the size of images, and the view's aspect.
    void set_size(const glm::ivec2& pixels);
    void set_budget(double ms) { options_.budget_ms = ms; }
    double budget() const { return options_.budget_ms; }

    /// Updates the light, within the budget of a frame.
    const LiveLinksState& frame();
    /// Bakes the scene at rest, in a thread of its own. Call after frame() has found it at rest,
    /// until this returns true: the light of the bake is displayed. Waits for at most `wait`. An
    /// edit discards the bake.
    bool bake(std::chrono::milliseconds wait);
    bool is_baking() const { return bake_ && baked_edits_ == edits_; }

    enum class Legend { none, beside };
    /// Display-referred image; false colours with a legend at the right, or without.
    Image picture(Legend legend = Legend::beside);
    glm::ivec2 size() const;  ///< image size without a legend [pixels]
    /// Luminance of the image at a pixel [cd/m²], in any mode.
    double luminance_at(const glm::ivec2& pixel);
    /// Illuminance of the surface at a pixel [lx], as in false colours; empty without a surface.
    std::optional<double> lux_at(const glm::ivec2& pixel);
    float exposure();        ///< factor from cd/m² to brightness
    LuxScale scale();        ///< for ViewMode::irradiance
    LuxScale error_scale();  ///< for ViewMode::error [%]
    /// [N] Estimated error of the displayed light [%]; see LiveLinks::error_estimate(). For solved
    /// light: the method's estimate, everywhere; < 0 if it has none.
    const std::vector<float>& error_estimate();
    const std::vector<glm::vec3>& irradiance() { return irradiance_of(seen()); }  ///< [N] [lx]

    const LiveLinks& light() const { return live_; }
    const Scene& scene() const { return shown_; }
    const std::vector<MovableObject>& things() const { return things_; }
    const std::vector<ViewLamp>& lamps() const { return lamps_; }
    const FrameCosts& costs() const { return costs_; }  ///< light updates
    const FrameCosts& picture_costs() const { return picture_costs_; }
    ViewMode mode() const { return mode_; }
    bool has_automatic_exposure() const { return !exposure_; }
    float stops() const { return stops_; }
    double time() const { return time_; }
    const std::optional<SunPosition>& sun() const { return sun_; }  ///< if moved
    bool has_sun() const { return sun_light_.has_value(); }
    double sky_angle() const { return sky_angle_; }
    const Animation& animation() const { return animation_; }
    const SessionOptions& options() const { return options_; }
    const gpu::Device& device() const { return *device_; }

private:
    /// A light of the session: by links, or solved. Empty members are computed on demand.
    struct Seen {
        std::vector<glm::vec3> irradiance;
        std::vector<float> error_estimate;
        std::optional<Image> map;
        bool has_balls = false;  ///< balls_ belong to it
    };

    Seen& seen() { return shows_solved() ? by_solver_ : by_links_; }
    const std::vector<glm::vec3>& irradiance_of(Seen& seen);
    void note_edit();
    glm::vec3 factor_of(const ViewLamp& lamp) const;
    Lumels shown_lumels() const;
    void draw_lit_balls(Image& light);
    void draw_lux_balls(Image& lux);
    MovableObject& picked_thing();
    std::optional<std::uint32_t> object_of(std::uint32_t instance) const;
    const RayScene& rays();
    std::optional<Picked> seen_at(const glm::vec2& place);
    glm::vec3 emission_of(const Lumel& lumel) const;
    Image make_picture(Legend legend);
    Image coloured(const Image& map, const LuxScale& scale, const char* unit, Legend legend);
    Image lit_picture();
    Image links_picture();
    void draw_link(Image& picture, const glm::vec3& from, const ViewLink& link, float heat);
    void put(std::uint32_t thing);
    void hide(std::uint32_t thing);
    void take_light(const ViewSession& before);
    glm::vec3 away();
    void place_sky();
    void apply(const ViewLamp& lamp);
    const Image& map();
    Image error_map();
    const Image& render(const Image& map, PreviewShows shows);
    void check_inside(const glm::ivec2& pixel) const;

    const gpu::Device* device_;
    SessionOptions options_;
    Animation animation_;
    Scene shown_;                   ///< as displayed
    std::vector<glm::mat4> given_;  ///< [instances] transforms in the scene
    std::vector<MovableObject> things_;
    LiveLinks live_;
    NearLumels near_;
    Atlas drawn_;  ///< without deleted objects
    std::vector<ViewLamp> lamps_;
    std::vector<glm::vec3> played_;  ///< [materials] factors of the animation
    std::optional<std::uint32_t> sun_light_;
    float sun_factor_ = 1.0f;  ///< relative illuminance at its current position
    ViewCamera camera_;
    std::optional<Picked> picked_;
    std::optional<Picked> probe_;
    std::optional<glm::ivec2> pixel_;
    std::optional<float> exposure_;
    float stops_ = 0.0f;
    ViewMode mode_ = ViewMode::lit;
    std::optional<LuxScale> scale_, error_scale_;
    std::optional<SunPosition> sun_;
    glm::vec3 sky_{1.0f};  ///< user's factor
    double sky_angle_ = 0.0, time_ = 0.0;
    FrameCosts costs_, picture_costs_;
    std::uint64_t edits_ = 0;
    std::optional<SolvedLight> solved_;  ///< for the current scene
    bool shows_solved_ = false;
    Seen by_links_, by_solver_;
    double probe_spacing_ = 0.0;          ///< [m], 0: none
    std::vector<glm::vec3> ball_places_;  ///< for that spacing
    std::vector<ProbeBall> balls_;
    bool balls_of_solved_ = false;
    // Created on demand.
    std::optional<RayScene> rays_;
    std::optional<Preview> preview_;             ///< shows drawn_
    std::uint64_t baked_edits_ = 0;              ///< edits_ when the last bake began
    std::optional<std::uint64_t> failed_edits_;  ///< edits_ of the last bake that failed
    std::optional<BakeAside> bake_;              ///< that has not been taken
};

/// The session and its display settings as JSON.
Json state_of(ViewSession& session);

}  // namespace lumel
