#include "bake/play.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "bake/poses.h"
#include "bake/report.h"
#include "bake/setting.h"
#include "bake/stages.h"
#include "core/log.h"
#include "finish/finish.h"
#include "images/image_files.h"
#include "live/still_part.h"
#include "output/folder.h"
#include "output/movie.h"
#include "preview/preview.h"
#include "scene/animation.h"
#include "json/json_file.h"

namespace lumel {
namespace {

constexpr int kMostFrames = 100'000;
constexpr const char* kFilm = "play.mp4";
constexpr const char* kFramePattern = "frame-%04d.png";
/// Cancellation is polled at least this often [ms].
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
    if (frames > double(kMostFrames))
        throw Error(ErrorKind::input, fmt::format("--fps {}", options.fps),
                    fmt::format("makes {:.0f} frames of the animation, more than the {} that are "
                                "made at once; use fewer --frames",
                                frames, kMostFrames));
    return int(frames);
}

bool has_material(const Scene& scene, const Instance& instance, int material)
{
    const auto& primitives = scene.meshes[std::size_t(instance.mesh)].primitives;
    return std::any_of(primitives.begin(), primitives.end(),
                       [&](const Primitive& p) { return p.material == material; });
}

/// Lamps of the scene whose light changes.
struct ChangingLamp {
    std::uint32_t instance = 0;
    const AnimatedMaterial* material = nullptr;
    glm::vec3 factor{1.0f};  ///< last set in the live scene
};

/// An instance's light changes as a whole: its other materials must be dark.
std::vector<ChangingLamp> changing_lamps(const Scene& scene, const Animation& animation)
{
    std::vector<ChangingLamp> lamps;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        for (const AnimatedMaterial& material : animation.materials) {
            const Instance& instance = scene.instances[i];
            if (!has_material(scene, instance, material.material))
                continue;
            for (int other = 0; other < int(scene.materials.size()); ++other)
                if (other != material.material && has_material(scene, instance, other) &&
                    scene.materials[std::size_t(other)].emitted != glm::vec3(0.0f))
                    throw Error(
                        ErrorKind::input, fmt::format("{}: \"{}\"", scene.path, instance.name),
                        "has several emissive materials, and the light of one changes; give "
                        "each a mesh of its own");
            lamps.push_back({i, &material});
        }
    return lamps;
}

/// What is emitted as a part of the most there will be, which the live scene is made with.
glm::vec3 emission_factor(const AnimatedMaterial& material, double time)
{
    const glm::vec3 now = emitted_at(material, time), most = most_emitted(material);
    glm::vec3 factor(0.0f);
    for (int c = 0; c < 3; ++c)
        if (most[c] > 0.0f)
            factor[c] = now[c] / most[c];
    return factor;
}

Scene at_its_brightest(Scene scene, const Animation& animation)
{
    for (const AnimatedMaterial& material : animation.materials)
        scene.materials[std::size_t(material.material)].emitted = most_emitted(material);
    return scene;
}

LiveOptions live_options(const PlayOptions& options, const std::vector<std::uint32_t>& movers)
{
    LiveOptions live;
    live.atlas = options.atlas;
    live.solver = std::get<ProgressiveOptions>(options.solver);
    live.movers = movers;
    live.still = movers.empty();
    // Where only lamps change there is nothing to cross.
    live.redistribution = live.still ? Redistribution::incremental : options.redistribution;
    live.residual = options.residual;
    return live;
}

LeakyOptions leaky_options(const PlayOptions& options, const std::vector<std::uint32_t>& movers)
{
    LeakyOptions leaky;
    leaky.atlas = options.atlas;
    leaky.solver = std::get<DirectionsOptions>(options.solver);
    leaky.leak = options.leak;
    leaky.movers = movers;
    leaky.still = movers.empty();
    leaky.residual = options.residual;
    return leaky;
}

/// A scene, how it changes, and the light that follows.
class Player {
    template <class Body>
    auto with_light(const Body& body)
    {
        return live_ ? body(*live_) : body(*leaky_);
    }

public:
    /// `scene`: posed as the first frame.
    Player(const gpu::Device& device, Scene scene, const Animation& animation,
           const std::vector<std::uint32_t>& movers, const PlayOptions& options)
        : device_(&device),
          animation_(&animation),
          options_(options),
          movers_(movers),
          lamps_(changing_lamps(scene, animation)),
          shown_(std::move(scene)),
          exposure_(options.exposure)
    {
        Scene brightest = at_its_brightest(shown_, animation);
        if (std::holds_alternative<DirectionsOptions>(options.solver))
            leaky_.emplace(device, std::move(brightest), leaky_options(options, movers));
        else
            live_.emplace(device, std::move(brightest), live_options(options, movers));
        if (options.camera < 0 && shown_.cameras.empty())
            chosen_ = choose_view(shown_, RayScene(shown_));
    }

    /// Moves the scene, and its light, to the time of a frame. Nothing if stopped before.
    std::optional<FrameRow> follow(int frame, Stages& stages)
    {
        const double time = time_of(options_, frame);
        change_to(time);
        FrameRow row{.file = frame_name(frame), .seconds = time};
        const std::uint64_t before = hemicubes_;
        while (!row.at_rest) {
            if (!stages.progress(double(frame) / double(options_.frames), hemicubes_))
                return std::nullopt;
            const double left = options_.budget_ms > 0.0 ? options_.budget_ms - row.update_ms
                                                         : std::numeric_limits<double>::max();
            if (left <= 0.0)
                break;
            const double slice = std::min(left, kSlice);
            const LiveState state = with_light([&](auto& light) { return light.update(slice); });
            row.update_ms += state.milliseconds;
            row.residual = state.residual;
            row.at_rest = state.at_rest;
            hemicubes_ = state.hemicubes;
        }
        row.hemicubes = hemicubes_ - before;
        return row;
    }

    /// The picture of the scene as it stands, tone-mapped.
    Image picture()
    {
        const Image map = with_light([&](auto& light) {
            return finish_map(shown_, light.atlas(), light.lumels(), light.irradiance());
        });
        Image image = render_preview(*device_, shown_, atlas(), map, view(), options_.width);
        // One exposure for all, or the pictures would flicker.
        if (exposure_ <= 0.0f && bright_end(image) > 0.0f)
            exposure_ = choose_exposure(image);
        return tone_map(image, exposure_);
    }

    const Atlas& atlas() const { return live_ ? live_->atlas() : leaky_->atlas(); }
    float exposure() const { return exposure_; }
    /// What became of it, once all is played.
    Report report(const PlayOptions& options, int height, std::vector<FrameRow> frames,
                  const Stages& stages)
    {
        return with_light([&](auto& light) {
            return play_report(options,
                               {light.scene(), light.atlas(), light.lumels(), light.times()},
                               *device_, height, std::move(frames), stages);
        });
    }

private:
    void change_to(double time)
    {
        pose(shown_, *animation_, time);
        with_light([&](auto& light) {
            for (const std::uint32_t i : movers_)
                light.move(i, shown_.instances[i].transform);
            for (ChangingLamp& lamp : lamps_) {
                const glm::vec3 factor = emission_factor(*lamp.material, time);
                if (factor != lamp.factor)
                    light.set_emission(lamp.instance, factor);
                lamp.factor = factor;
            }
        });
    }

    View view() const
    {
        return chosen_ ? *chosen_
                       : view_of(shown_.cameras[std::size_t(std::max(options_.camera, 0))]);
    }

    const gpu::Device* device_;
    const Animation* animation_;
    PlayOptions options_;
    std::vector<std::uint32_t> movers_;
    std::vector<ChangingLamp> lamps_;
    Scene shown_;                      ///< as the current frame has it
    std::optional<LiveScene> live_;    ///< either this
    std::optional<LeakyScene> leaky_;  ///< or this
    std::optional<View> chosen_;       ///< where the file has no camera
    float exposure_;
    std::uint64_t hemicubes_ = 0;
};

/// The scene at the first frame, with all warnings for the user.
Scene read_start(const std::string& path, const Animation& animation, const PlayOptions& options)
{
    Scene scene = read_gltf(path);
    check_camera(scene, options.camera);
    scene.warnings.insert(scene.warnings.end(), animation.warnings.begin(),
                          animation.warnings.end());
    pose(scene, animation, 0.0);
    return scene;
}

/// What an earlier, longer film has left beyond these frames.
void outdate_beyond(OutputFolder& output, const std::string& folder, int frames)
{
    namespace fs = std::filesystem;
    std::error_code ignored;
    for (int frame = frames; fs::exists(fs::path(folder) / frame_name(frame), ignored); ++frame)
        output.outdate(frame_name(frame));
}

/// Makes the film if it can; else prints how to make it.
bool film(const OutputFolder& output, double fps)
{
    const std::string ffmpeg = find_ffmpeg();
    if (ffmpeg.empty()) {
        log_info(fmt::format("ffmpeg is not installed, so there is no {}; with it: ffmpeg "
                             "-framerate {} -i {} -pix_fmt yuv420p {}",
                             kFilm, fps, kFramePattern, kFilm));
        return false;
    }
    const bool made = make_film(ffmpeg, output.path(""), kFramePattern, fps, kFilm);
    if (!made)
        log_warning(fmt::format("{} could not make {} of the frames", ffmpeg, kFilm));
    return made;
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
    const std::vector<std::uint32_t> movers = movers_of(animation, start);
    if (movers.empty() && changing_lamps(start, animation).empty())
        throw Error(ErrorKind::input, scene_path,
                    "its animation moves nothing that is shown, and changes no light");
    check_poses(start, animation, options.frames, options.fps);
    // What can fail before the long work should.
    OutputFolder output(folder);
    const gpu::Device device(options.device);
    stages.watch(device);
    tell_warnings(start);

    stages.begin("charts");
    Player player(device, std::move(start), animation, movers, options);
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
    const bool filmed = !stages.stopped() && film(output, options.fps);
    stages.end();
    device.check_validation();
    const int written = int(rows.size());
    Report report = player.report(options, height, std::move(rows), stages);
    for (const FrameRow& row : report.frames)
        report.files.push_back(row.file);
    if (filmed)
        report.files.emplace_back(kFilm);
    report.files.emplace_back(kReportFile);
    const Json json = to_json(report);
    write_json(output.path(kReportFile), json);
    outdate_beyond(output, folder, written);
    if (!filmed)
        output.outdate(kFilm);
    output.commit();
    return {written, stages.seconds(), stages.stopped(), json_text(json)};
}

}  // namespace lumel
