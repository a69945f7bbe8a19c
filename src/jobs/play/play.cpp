#include "jobs/play/play.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/core/log.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "jobs/play/play_report.h"
#include "jobs/play/played_light.h"
#include "jobs/solve/poses.h"
#include "jobs/solve/setting.h"
#include "jobs/solve/stages.h"
#include "results/files/folder.h"
#include "results/files/movie.h"
#include "results/preview/preview.h"
#include "scene/load/albedo_cap.h"
#include "scene/values/animation.h"

namespace lumel {
namespace {

constexpr int kMaxFrames = 100'000;
constexpr const char* kFilms[] = {"play.mp4", "play.webm"};
constexpr const char* kFramePattern = "frame-%04d.png";
/// Maximum time between checks for cancellation [ms].
constexpr double kSlice = 200.0;

double time_of(const PlayOptions& options, int frame)
{
    return double(frame) / options.fps;
}

std::string frame_name(int frame)
{
    return fmt::format("frame-{:04d}.png", frame + 1);
}

int frames_of(const PlayOptions& options, const Animation& animation)
{
    if (options.frames > 0)
        return options.frames;
    const double frames = std::max(1.0, std::round(animation.duration * options.fps));
    if (frames > double(kMaxFrames))
        throw Error(
            ErrorKind::input, fmt::format("--fps {}", options.fps),
            fmt::format("makes {:.0f} frames, more than the limit of {}; use fewer --frames",
                        frames, kMaxFrames));
    return int(frames);
}

/// A scene, its animation, and its light.
class Player {
public:
    /// `scene`: posed as in the first frame.
    Player(const gpu::Device& device, Scene scene, const Animation& animation,
           const PlayOptions& options)
        : device_(&device),
          animation_(&animation),
          options_(options),
          shown_(std::move(scene)),
          light_(make_played_light(device, shown_, animation, options)),
          exposure_(options.exposure)
    {
        if (options.camera < 0 && shown_.cameras.empty())
            chosen_ = choose_view(shown_, RayScene(shown_));
    }

    /// Updates the scene and its light to the time of a frame. Empty if stopped before.
    std::optional<FrameRow> follow(int frame, Stages& stages)
    {
        const double time = time_of(options_, frame);
        pose(shown_, *animation_, time);
        light_->change_to(shown_, time);
        FrameRow row{.file = frame_name(frame), .seconds = time};
        while (!row.at_rest) {
            if (!stages.progress(double(frame) / double(options_.frames), light_->shots()))
                return std::nullopt;
            const double left = options_.budget_ms > 0.0 ? options_.budget_ms - row.update_ms
                                                         : std::numeric_limits<double>::max();
            if (left <= 0.0)
                break;
            light_->update(std::min(left, kSlice), row);
        }
        return row;
    }

    /// Tone-mapped image of the current scene.
    Image picture()
    {
        const Image map =
            finish_map(shown_, light_->atlas(), light_->shown_lumels(), light_->irradiance());
        Preview preview(*device_, shown_, atlas());
        const Image& light = preview.draw(shown_, map, view(), options_.width);
        // One exposure for all frames avoids flicker.
        if (exposure_ <= 0.0f)
            exposure_ = choose_exposure(light).value_or(0.0f);
        return preview.tone_mapped(exposure_ > 0.0f ? exposure_ : 1.0f);
    }

    const Atlas& atlas() const { return light_->atlas(); }
    float exposure() const { return exposure_; }
    /// Report of the finished animation.
    Report report(const PlayOptions& options, int height, std::vector<FrameRow> frames,
                  const Stages& stages) const
    {
        return play_report(options, *light_, *device_, height, std::move(frames), stages);
    }

private:
    View view() const
    {
        return chosen_ ? *chosen_
                       : view_of(shown_.cameras[std::size_t(std::max(options_.camera, 0))]);
    }

    const gpu::Device* device_;
    const Animation* animation_;
    PlayOptions options_;
    Scene shown_;  ///< as in the current frame
    std::unique_ptr<PlayedLight> light_;
    std::optional<View> chosen_;  ///< if the file has no camera
    float exposure_;
};

/// The scene at the first frame, with all warnings.
Scene read_start(const std::string& path, const Animation& animation, const PlayOptions& options)
{
    Scene scene = read_gltf(path);
    cap_albedo(scene, scene.max_albedo);
    check_camera(scene, options.camera);
    scene.warnings.insert(scene.warnings.end(), animation.warnings.begin(),
                          animation.warnings.end());
    pose(scene, animation, 0.0);
    return scene;
}

/// Removes the frames of an earlier, longer animation.
void outdate_beyond(OutputFolder& output, const std::string& folder, int frames)
{
    namespace fs = std::filesystem;
    std::error_code ignored;
    for (int frame = frames; fs::exists(fs::path(folder) / frame_name(frame), ignored); ++frame)
        output.outdate(frame_name(frame));
}

/// Makes the film, or notes how to make it. Returns its name, or "".
std::string film(const OutputFolder& output, const PlayOptions& options)
{
    if (options.film == Film::none)
        return {};
    const std::string ffmpeg = find_ffmpeg(), name = kFilms[options.film == Film::mp4 ? 0 : 1];
    if (ffmpeg.empty()) {
        log_info(fmt::format("ffmpeg is not installed, so there is no {}; to make it: ffmpeg "
                             "-framerate {} -i {} -pix_fmt yuv420p {}",
                             name, options.fps, kFramePattern, name));
        return {};
    }
    if (make_film(ffmpeg, output.path(""), kFramePattern, options.fps, name))
        return name;
    log_warning(fmt::format("{} could not make {} of the frames", ffmpeg, name));
    return {};
}

}  // namespace

PlaySummary play(const std::string& scene_path, const std::string& folder, const PlayOptions& given,
                 const ProgressFunction& progress)
{
    PlayOptions options = given;
    Stages stages(progress);
    stages.begin("reading");
    const Animation animation = read_animation(scene_path, options.animation);
    Scene start = read_start(scene_path, animation, options);
    options.frames = frames_of(options, animation);
    if (!changes_anything(start, animation))
        throw Error(ErrorKind::input, scene_path,
                    "its animation moves no visible object and changes no light");
    check_poses(start, animation, options.frames, options.fps);
    // Checks for failures before the long work.
    OutputFolder output(folder);
    const gpu::Device device(options.device);
    stages.watch(device);
    tell_warnings(start);

    stages.begin("charts");
    Player player(device, std::move(start), animation, options);
    for (const std::string& note : player.atlas().notes)
        log_info(note);
    stages.begin("playing");
    std::vector<FrameRow> rows;
    int height = 0;
    for (int frame = 0; frame < options.frames; ++frame) {
        const std::optional<FrameRow> row = player.follow(frame, stages);
        if (!row)
            break;
        const Image image = player.picture();
        height = image.height;
        options.width = image.width;
        write_png(output.path(row->file), image);
        rows.push_back(*row);
    }
    if (rows.empty())
        throw_stopped();
    options.exposure = player.exposure();

    stages.begin("finishing");
    const std::string filmed = stages.stopped() ? "" : film(output, options);
    stages.end();
    device.check_validation();
    const int written = int(rows.size());
    Report report = player.report(options, height, std::move(rows), stages);
    for (const FrameRow& row : report.frames)
        report.files.push_back(row.file);
    if (!filmed.empty())
        report.files.push_back(filmed);
    report.files.emplace_back(kReportFile);
    const Json json = to_json(report);
    write_json(output.path(kReportFile), json);
    outdate_beyond(output, folder, written);
    for (const char* const old : kFilms)
        if (filmed != old)
            output.outdate(old);
    output.commit();
    return {written, stages.seconds(), stages.stopped(), json_text(json)};
}

}  // namespace lumel
