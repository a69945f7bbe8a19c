#pragma once
// A lit scene under the hand: looked at, picked, moved, dimmed, and kept lit meanwhile.

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
    std::uint32_t link_rays = LiveLinksOptions{}.rays;  ///< of a lumel
    std::uint32_t seed = 1;
    bool filter = true;
    double residual = LiveLinksOptions{}.residual;
    double budget_ms = 15.0;    ///< of the light of a frame
    int camera = -1;            ///< index into the file's cameras; -1: the first, or one chosen
    int width = 640;            ///< of pictures [pixels]
    std::size_t animation = 0;  ///< index into the file's animations
    std::vector<std::string> movable;     ///< names of what may move; empty: what is small
    std::optional<SolverOptions> solver;  ///< that the scene is lit by first; none: links alone
};

enum class ViewMode {
    lit,
    irradiance,  ///< in false colours
    lumels,      ///< a colour for each chart, lumels as a board
    links,       ///< what sends light to a lumel, as lines in space
    error,       ///< what is not settled of it, in false colours
};
inline constexpr int kViewModes = 5;

/// What lies under a pixel.
struct Picked {
    std::uint32_t instance = 0;
    int material = 0;
    std::uint32_t lumel = kNoLumel;
    std::optional<std::uint32_t> thing;  ///< none: it stays where it is
    glm::vec3 place{0.0f}, normal{0.0f};
    float distance = 0.0f;  ///< [m] from the eye
};

/// A light or an emissive material.
struct ViewLamp {
    std::string name;
    bool is_light = false;
    std::uint32_t index = 0;  ///< into the scene's lights or materials
    glm::vec3 factor{1.0f};   ///< by hand
};

/// What a ray that a lumel keeps has met.
struct ViewLink {
    std::string name;       ///< of an instance, "sky", or empty: nothing that reflects
    glm::vec3 to{0.0f};     ///< where it is; of the sky: a diagonal of the scene away [m]
    glm::vec3 light{0.0f};  ///< that it brings, emission included [lx]
};

/// What frames, or pictures, took by the clock.
struct FrameCosts {
    int frames = 0;
    double last_ms = 0.0, most_ms = 0.0, all_ms = 0.0;

    void add(double ms);
};

/// The scene is laid out once; whatever is changed afterwards is followed by LiveLinks, a frame's
/// budget at a time. Functions that name what the scene does not have throw Error{input} and change
/// nothing.
class ViewSession {
public:
    /// scene: with all its lights. animation: of its file, or an empty one. Traces all links. The
    /// device must outlive it.
    ViewSession(const gpu::Device& device, Scene scene, Animation animation,
                const SessionOptions& options);
    ViewSession(const ViewSession&) = delete;
    ViewSession& operator=(const ViewSession&) = delete;

    /// Does what was done to another session of the same scene and animation, and looks as it does.
    /// Nothing is picked.
    void take_edits(const ViewSession& before);

    ViewCamera& camera() { return camera_; }
    const ViewCamera& camera() const { return camera_; }
    /// Looks through a camera of the file.
    void take_camera(int index);
    /// Around what is picked, or what the middle of the picture shows [rad].
    void orbit(float around, float over);

    /// What the picture shows at a pixel.
    std::optional<Picked> seen_at(const glm::ivec2& pixel);
    /// Picks what the picture shows at a pixel: nothing, where nothing is.
    void pick(const glm::ivec2& pixel);
    /// The first instance of that name.
    void pick(const std::string& name);
    void unpick();
    const std::optional<Picked>& picked() const { return picked_; }
    const std::optional<glm::ivec2>& pixel() const { return pixel_; }

    /// The lumel whose links are shown: what is picked, or what lies under this pixel instead.
    void probe(const glm::ivec2& pixel);
    /// The links of that lumel; empty where there is none. The sky's part of what sources send, and
    /// lamps that are no surface, have no links.
    std::vector<ViewLink> links();

    // What is picked must be a thing.
    void move(const glm::vec3& way);  ///< [m]
    void turn(float angle);           ///< about +y through its middle [rad]
    void remove();

    void set_lamp(const std::string& name, const glm::vec3& factor);
    /// What is picked must emit.
    void dim(const glm::vec3& factor);
    /// The base colour of what is picked, 0 to 1.
    void paint(const glm::vec3& colour);
    void set_sky(const glm::vec3& factor);
    const glm::vec3& sky() const { return sky_; }
    void turn_sky(double angle);  ///< [rad] counter-clockwise, from how it was given
    /// The sun of the options, or else the first directional light. Below the horizon it is off.
    void set_sun(const SunPosition& sun);
    void set_time(double seconds);

    void set_exposure(std::optional<float> factor) { exposure_ = factor; }  ///< none: automatic
    /// Or as it is now.
    void set_automatic_exposure(bool automatic);
    void step_exposure(float stops) { stops_ += stops; }
    void set_mode(ViewMode mode) { mode_ = mode; }

    /// Shows light probes as balls, over a grid of that spacing [m] and where the file names them,
    /// in ViewMode::lit and irradiance. 0: none. They stay there, whatever moves. Throws
    /// Error{input} if there would be too many.
    void set_probes(double spacing);
    double probe_spacing() const { return probe_spacing_; }
    /// Of the light that is shown, when it was last at rest; none before its first rest.
    const std::vector<ProbeBall>& probe_balls();

    /// The scene as it stands, its materials as that model reads them. Throws Error.
    StandingScene standing(MaterialModel model) const;
    std::uint64_t edits() const { return edits_; }  ///< changes to the scene so far
    /// Shows that light from now on, of the scene as it was after so many edits. False if there
    /// were more since, and it is not taken.
    bool take_solved(SolvedLight light, std::uint64_t edits);
    /// Shows what was solved of the scene as it stands, or else the light of links. Throws
    /// Error{input} if nothing was.
    void show_solved(bool solved);
    /// What was solved of the scene as it stands; null: nothing.
    const SolvedLight* solved() const { return solved_ ? &*solved_ : nullptr; }
    /// Is that shown, and not the light of links? Never in ViewMode::links.
    bool shows_solved() const;

    /// Of the false colours of this mode; none: automatic.
    void set_scale(const std::optional<LuxScale>& scale);

    /// Pictures are so large, and their shape is that of the view.
    void set_size(const glm::ivec2& pixels);
    void set_budget(double ms) { options_.budget_ms = ms; }
    double budget() const { return options_.budget_ms; }

    /// Follows what has changed, for the budget of a frame.
    const LiveLinksState& frame();

    enum class Legend { none, beside };
    /// What is to be seen, display-referred; false colours with a legend at their right, or none.
    Image picture(Legend legend = Legend::beside);
    glm::ivec2 size() const;  ///< of pictures, without a legend [pixels]
    /// Luminance that the picture has at a pixel [cd/m²], whatever the mode.
    double luminance_at(const glm::ivec2& pixel);
    /// Illuminance of the surface at a pixel [lx], as false colours have it; none where nothing is.
    std::optional<double> lux_at(const glm::ivec2& pixel);
    float exposure();        ///< factor from cd/m² to brightness
    LuxScale scale();        ///< of the mode irradiance
    LuxScale error_scale();  ///< of the mode error [%]
    /// [N] What is not settled of it, as it is shown [%]; see LiveLinks::error_estimate(). Of what
    /// was solved: the error that the method states, everywhere; less than 0 if it states none.
    const std::vector<float>& error_estimate();
    const std::vector<glm::vec3>& irradiance() { return irradiance_of(seen()); }  ///< [N] [lx]

    const LiveLinks& light() const { return live_; }
    const Scene& scene() const { return shown_; }
    const std::vector<MovableObject>& things() const { return things_; }
    const std::vector<ViewLamp>& lamps() const { return lamps_; }
    const FrameCosts& costs() const { return costs_; }  ///< of light
    const FrameCosts& picture_costs() const { return picture_costs_; }
    ViewMode mode() const { return mode_; }
    bool has_automatic_exposure() const { return !exposure_; }
    float stops() const { return stops_; }
    double time() const { return time_; }
    const std::optional<SunPosition>& sun() const { return sun_; }  ///< where it was put
    bool has_sun() const { return sun_light_.has_value(); }
    double sky_angle() const { return sky_angle_; }
    const Animation& animation() const { return animation_; }
    const SessionOptions& options() const { return options_; }
    const gpu::Device& device() const { return *device_; }

private:
    /// A light of the session: of links, or what was solved. What is empty is made when it is asked
    /// for.
    struct Seen {
        std::vector<glm::vec3> irradiance;
        std::vector<float> error_estimate;
        std::optional<Image> map;
        bool has_balls = false;  ///< balls_ were found in it
    };

    Seen& seen() { return shows_solved() ? by_solver_ : by_links_; }
    const std::vector<glm::vec3>& irradiance_of(Seen& seen);
    void note_edit();
    glm::vec3 factor_of(const ViewLamp& lamp) const;
    Lumels lumels_of_solved() const;
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
    Scene shown_;                   ///< as it is drawn
    std::vector<glm::mat4> given_;  ///< [instances] where the scene has them
    std::vector<MovableObject> things_;
    LiveLinks live_;
    NearLumels near_;
    Atlas drawn_;  ///< without what is deleted
    std::vector<ViewLamp> lamps_;
    std::vector<glm::vec3> played_;  ///< [materials] factors of the animation
    std::optional<std::uint32_t> sun_light_;
    float sun_factor_ = 1.0f;  ///< of its illuminance, where it stands now
    ViewCamera camera_;
    std::optional<Picked> picked_;
    std::optional<Picked> probe_;
    std::optional<glm::ivec2> pixel_;
    std::optional<float> exposure_;
    float stops_ = 0.0f;
    ViewMode mode_ = ViewMode::lit;
    std::optional<LuxScale> scale_, error_scale_;
    std::optional<SunPosition> sun_;
    glm::vec3 sky_{1.0f};  ///< factor by hand
    double sky_angle_ = 0.0, time_ = 0.0;
    FrameCosts costs_, picture_costs_;
    std::uint64_t edits_ = 0;
    std::optional<SolvedLight> solved_;  ///< of the scene as it stands
    bool shows_solved_ = false;
    Seen by_links_, by_solver_;
    double probe_spacing_ = 0.0;          ///< [m], 0: none are shown
    std::vector<glm::vec3> ball_places_;  ///< of that spacing
    std::vector<ProbeBall> balls_;
    bool balls_of_solved_ = false;
    // Made when they are asked for.
    std::optional<RayScene> rays_;
    std::optional<Preview> preview_;  ///< of drawn_
};

/// The session and what it shows as JSON.
Json state_of(ViewSession& session);

}  // namespace lumel
