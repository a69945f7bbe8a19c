#include "viewer/window/window.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <imgui.h>

#include "base/core/clock.h"
#include "base/core/error.h"
#include "base/core/log.h"
#include "base/images/image_files.h"
#include "jobs/solve/setting.h"
#include "jobs/solve/stages.h"
#include "results/files/folder.h"
#include "scene/gltf/document.h"
#include "scene/values/animation.h"
#include "viewer/session/player.h"
#include "viewer/session/save.h"
#include "viewer/window/controls.h"
#include "viewer/window/first_picture.h"
#include "viewer/window/panel.h"
#include "viewer/window/solving.h"

namespace lumel {
namespace {

constexpr double kIdle = 0.05;          ///< between input checks while nothing changes [s]
constexpr double kBetweenNews = 200.0;  ///< between progress updates of a bake [ms]
constexpr double kLongest = 0.1;        ///< maximum frame time for keys and animation [s]
constexpr float kStrides = 5.0f;        ///< strides across the scene
constexpr int kFirstCoarse = 4;         ///< pixel size of the preview before there is light
constexpr ImU32 kFrame = IM_COL32(0, 230, 255, 255);

std::string title_of(const ScriptRun& run)
{
    return "lumel: " + std::filesystem::path(run.scene).filename().string();
}

/// The animation of a file, if it has one.
Animation animation_of(const ScriptRun& run, const SessionOptions& options)
{
    const bool moves = load_gltf_document(run.scene).root().count("animations") > 0;
    return moves ? read_animation(run.scene, options.animation) : Animation{};
}

class ViewWindow {
public:
    ViewWindow(const ScriptRun& run, const SessionOptions& options, Stages& stages);

    ViewSummary show();

private:
    void wait_for_light();
    void step();
    void bake();
    void play();
    void make_picture();
    Image draw(double wait, bool read);
    Image seen();
    void lay_out();
    void show_picture() const;
    void show_frame() const;
    void act();
    void shoot();
    void save();
    void solve_anew();
    void solve_first();
    void end_script();
    bool is_busy() const;

    const ScriptRun* run_;
    SessionOptions options_;
    Stages* stages_;
    std::vector<ScriptCommand> script_;
    Animation animation_;
    Scene scene_;
    View view_;  ///< until there is a session
    std::optional<gpu::Device> device_;
    Screen screen_;
    std::unique_ptr<ViewSession> session_;
    std::optional<OutputFolder> output_;  ///< the script's, while it plays
    std::optional<ScriptPlayer> player_;
    std::vector<std::string> files_;
    Solving solving_;
    Controls controls_;
    UiState desk_;
    int shots_ = 0;
    Clock::time_point last_ = Clock::now();
};

glm::ivec2 first_size(const View& view, int width)
{
    constexpr int kMax = 16384;  // side of an image [pixels]
    return {width + kPanelWidth, picture_height(width, view.aspect, kMax)};
}

ViewWindow::ViewWindow(const ScriptRun& run, const SessionOptions& options, Stages& stages)
    : run_(&run),
      options_(options),
      stages_(&stages),
      script_(run.script.empty() ? std::vector<ScriptCommand>() : script_of(run.script)),
      animation_(animation_of(run, options)),
      scene_(scene_to_view(run.scene, animation_, options)),
      view_(first_view(scene_, options.camera)),
      screen_(title_of(run), first_size(view_, options.width))
{
    tell_warnings(scene_);
    if (!script_.empty()) {
        output_.emplace(run.folder);
        if (options.solver)
            script_.insert(script_.begin(), solve_command(*options.solver));
    }
    device_.emplace(options.device);
    stages.watch(*device_);
    desk_.rays = int(options.link_rays);
    desk_.atlas = options.atlas.size;
    desk_.seed = int(options.seed);
    if (options.solver)
        desk_.method.id = method_of(options.solver->method).id;
    desk_.draws = fmt::format("light and image by {}, window by {}", device_->info().name,
                              screen_.draws_by());
}

void ViewWindow::lay_out()
{
    const glm::ivec2 all = screen_.size();
    const bool has_panel = desk_.panel && session_ && all.x >= kRoomForPanel;
    const glm::ivec2 area(all.x - (has_panel ? kPanelWidth : 0), all.y);
    if (area != desk_.area)
        desk_.changed = true;
    desk_.area = area;
}

/// Traces all links in a separate thread; meanwhile shows the unlit scene.
void ViewWindow::wait_for_light()
{
    stages_->begin("tracing");
    auto tracing = std::async(std::launch::async, [&] {
        return std::make_unique<ViewSession>(*device_, scene_, animation_, options_);
    });
    const RayScene rays(scene_);
    desk_.stride = glm::distance(rays.low(), rays.high()) / kStrides;
    const Clock::time_point start = Clock::now();
    bool goes_on = true;
    while (tracing.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        lay_out();
        View view = view_;
        view.aspect = float(desk_.area.x) / float(desk_.area.y);
        if (desk_.changed)
            screen_.take(first_picture(scene_, rays, view,
                                       glm::max(desk_.area / kFirstCoarse, glm::ivec2(1))));
        desk_.changed = false;
        desk_.message =
            fmt::format("{:.0f} s: tracing the rays of all lumels", ms_since(start) / 1000.0);
        draw(kIdle, false);
        goes_on = goes_on && stages_->progress(0.0);
        if (!goes_on)
            screen_.close();
    }
    session_ = tracing.get();
    for (const std::string& note : session_->light().atlas().notes)
        log_info(note);
    desk_.message.clear();
    desk_.changed = true;
}

bool ViewWindow::is_busy() const
{
    return player_ || desk_.playing || desk_.changed || !session_->light().state().at_rest;
}

/// Advances the animation by the clock, repeating it.
void ViewWindow::play()
{
    const double duration = animation_.duration;
    if (!desk_.playing || !(duration > 0.0)) {
        desk_.playing = false;
        return;
    }
    session_->set_time(std::fmod(session_->time() + desk_.passed, duration));
    desk_.changed = true;
}

/// Updates light by a frame, after the script's commands before it.
void ViewWindow::step()
{
    const std::uint64_t before = session_->light().state().all_sweeps;
    const bool was_at_rest = session_->light().state().at_rest;
    if (player_) {
        player_->step();
        desk_.changed = true;
        if (player_->done())
            end_script();
    } else {
        play();
        session_->frame();
    }
    desk_.light_ms = session_->costs().last_ms;
    desk_.changed |= before != session_->light().state().all_sweeps ||
                     was_at_rest != session_->light().state().at_rest;
}

/// Bakes the scene at rest beside the frames.
void ViewWindow::bake()
{
    const BakedLight* const before = session_->light().baked();
    session_->bake(std::chrono::milliseconds(0));
    desk_.changed |= before != session_->light().baked();
}

/// Retraces all links with other options; keeps edits.
void ViewWindow::solve_anew()
{
    if (player_)
        throw Error(ErrorKind::input, "", "wait for the end of the script to solve again");
    solving_.drop();
    const SessionOptions before = options_;
    options_.link_rays = std::uint32_t(desk_.rays);
    options_.atlas.size = desk_.atlas;
    options_.seed = std::uint32_t(desk_.seed);
    options_.budget_ms = session_->budget();
    view_ = session_->camera().view();
    desk_.changed = true;
    std::unique_ptr<ViewSession> old = std::move(session_);
    try {
        wait_for_light();
        session_->take_edits(*old);
    } catch (const Error&) {
        session_ = std::move(old);
        options_ = before;
        throw;
    }
    stages_->begin("showing");
}

void ViewWindow::end_script()
{
    files_ = player_->files();
    if (player_->has_quit())
        screen_.close();
    player_.reset();
    device_->check_validation();
    output_->commit();
    output_.reset();
}

void ViewWindow::make_picture()
{
    lay_out();
    if (!desk_.changed)
        return;
    const Clock::time_point start = Clock::now();
    session_->set_size(desk_.pixels());
    screen_.take(session_->picture(ViewSession::Legend::none));
    desk_.picture_ms = ms_since(start);
    desk_.changed = false;
}

void ViewWindow::show_picture() const
{
    const glm::vec2 texture(screen_.texture_size());
    const glm::vec2 area(desk_.area);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    if (!session_) {
        list.AddImage(screen_.texture(), {0.0f, 0.0f}, {area.x, area.y});
        return;
    }
    const auto coarse = float(desk_.coarse);
    const glm::vec2 all = coarse * texture;
    list.PushClipRect({0.0f, 0.0f}, {area.x, area.y});
    list.AddImage(screen_.texture(), {0.0f, 0.0f}, {all.x, all.y});
    list.PopClipRect();
}

/// Draws the bounds of the picked surface.
void ViewWindow::show_frame() const
{
    if (!session_ || !session_->picked() || session_->mode() == ViewMode::links)
        return;
    const auto [low, high] = bounds_of(session_->scene(), session_->picked()->instance);
    constexpr int kCorners = 8, kAxes = 3;
    std::array<std::optional<glm::vec2>, kCorners> places;
    for (int corner = 0; corner < kCorners; ++corner) {
        const glm::vec3 point(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                              corner & 4 ? high.z : low.z);
        places[std::size_t(corner)] = place_in_picture(session_->camera().view(), point);
    }
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({0.0f, 0.0f}, {float(desk_.area.x), float(desk_.area.y)});
    for (int corner = 0; corner < kCorners; ++corner)
        for (int axis = 0; axis < kAxes; ++axis) {
            const int other = corner | 1 << axis;
            const auto &a = places[std::size_t(corner)], &b = places[std::size_t(other)];
            if (other == corner || !a || !b)
                continue;
            const glm::vec2 from = *a * glm::vec2(desk_.area), to = *b * glm::vec2(desk_.area);
            list.AddLine({from.x, from.y}, {to.x, to.y}, kFrame);
        }
    list.PopClipRect();
}

/// Draws a frame of the window; processes input once there is a session.
Image ViewWindow::draw(double wait, bool read)
{
    screen_.begin(wait);
    const Clock::time_point now = Clock::now();
    desk_.passed = std::min(std::chrono::duration<double>(now - last_).count(), kLongest);
    last_ = now;
    show_picture();
    show_frame();
    if (session_) {
        controls_.act(*session_, desk_, screen_);
        if (desk_.area.x < screen_.size().x)
            show_panel(*session_, desk_);
        else
            show_legend(*session_);
        show_help(desk_);
    }
    show_line(desk_.message.empty() ? desk_.solving : desk_.message, desk_);
    return screen_.end(read);
}

/// Current image of the window. Widgets know their sizes in the second frame.
Image ViewWindow::seen()
{
    desk_.changed = true;
    make_picture();
    draw(0.0, false);
    return draw(0.0, true);
}

void ViewWindow::shoot()
{
    make_picture();  // the window size can have changed
    const std::string name = fmt::format("picture-{}.png", ++shots_);
    OutputFolder output(run_->folder);
    write_png(output.path(name), session_->picture());
    output.commit();
    files_.push_back(name);
    desk_.message = name + " written";
}

/// Saves a bake. Light pauses meanwhile; the window shows progress. Ctrl-C ends it early.
void ViewWindow::save()
{
    const std::string folder = (std::filesystem::path(run_->folder) / desk_.save_to).string();
    Clock::time_point shown = Clock::now();
    const BakeSummary saved = save_bake(*session_, folder, [&](const BakeProgress& progress) {
        if (ms_since(shown) > kBetweenNews) {
            shown = Clock::now();
            screen_.begin(0.0);
            show_picture();
            show_line(fmt::format("saving into {}: {} {:.0f} %", folder, progress.stage,
                                  100.0 * progress.fraction),
                      desk_);
            screen_.end(false);
        }
        return stages_->progress(0.0);
    });
    files_.push_back(desk_.save_to);
    desk_.message = fmt::format("{} baked in {:.1f} s", folder, saved.seconds);
}

/// Executes requests of the user.
void ViewWindow::act()
{
    const bool shoots = std::exchange(desk_.shoot, false), saves = std::exchange(desk_.save, false),
               solves = std::exchange(desk_.solve, false);
    try {
        if (shoots)
            shoot();
        if (saves)
            save();
        if (solves)
            solve_anew();
        if (player_) {
            if (std::exchange(desk_.stop, false))
                player_->stop_solving();
            desk_.solve_by = false;  // the script has its own solves
            note_progress(player_->solving(), desk_);
        } else {
            solving_.follow(*session_, desk_);
        }
    } catch (const Error& error) {
        desk_.message = error.what();
    }
}

/// Solves by the options' method. Links continue if it cannot start.
void ViewWindow::solve_first()
{
    try {
        solving_.begin(*session_, *options_.solver);
    } catch (const Error& error) {
        desk_.message = error.what();
    }
}

ViewSummary ViewWindow::show()
{
    wait_for_light();
    stages_->begin("showing");
    if (script_.empty() && options_.solver)
        solve_first();
    if (!script_.empty())
        player_.emplace(std::move(script_), run_->script, *session_, *output_, run_->folder,
                        [this] { return seen(); });
    while (screen_.is_open()) {
        if (!stages_->progress(0.0))
            break;
        if (is_busy())
            step();
        else
            bake();
        make_picture();
        const Clock::time_point start = Clock::now();
        const bool busy = is_busy();
        draw(busy ? 0.0 : kIdle, false);
        desk_.window_ms = busy ? ms_since(start) : desk_.window_ms;
        act();
    }
    if (player_)
        throw_stopped_script();
    stages_->end();
    device_->check_validation();
    return summary_of(run_->scene, *session_, files_, stages_->seconds());
}

}  // namespace

ViewSummary show_window(const ScriptRun& run, const SessionOptions& options,
                        const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    return ViewWindow(run, options, stages).show();
}

}  // namespace lumel
