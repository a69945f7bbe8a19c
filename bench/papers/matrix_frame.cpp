#include "bench/papers/matrix_frame.h"

#include <numeric>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "atlas/finish/finish.h"
#include "bench/stopwatch.h"
#include "jobs/solve/sources.h"
#include "links/live/live_links.h"
#include "methods/matrix/relight_session.h"
#include "results/preview/preview.h"

namespace lumel::bench {
namespace {

constexpr double kBakeError = 0.03;  ///< stated, of light that does not move
constexpr int kWidth = 256;          ///< of the picture [pixels]
constexpr float kIntensity = 0.1f;   ///< of the lamp [cd]
constexpr const char* kLamp = "frame lamp";

BakeOptions bake_options(const MatrixSpeedSettings& settings, const gpu::Device& device)
{
    MatrixOptions method = options_of<MatrixOptions>(settings.shared);
    method.transport.patches = std::uint32_t(settings.patches);
    method.form = device.can_read_blocks() ? MatrixForm::bc1 : MatrixForm::tiles;
    BakeOptions options;
    options.solver.method = method;
    options.solver.target_error = kBakeError;
    options.atlas.size = settings.shared.size;
    return options;
}

/// The scene, and a lamp in the middle of it.
Scene scene_with_lamp(const Settings& settings)
{
    const SolveScene world = prepare(settings, settings.size);
    Scene scene = world.scene;
    PunctualLight lamp{.name = kLamp, .intensity = kIntensity};
    lamp.transform[3] = glm::vec4(0.5f * (world.rays.low() + world.rays.high()), 1.0f);
    scene.lights = {lamp};
    return scene;
}

/// The lamp's place in frame `number`.
glm::dvec3 lamp_at(const SolveScene& scene, int number, int frames)
{
    const glm::vec3 low = scene.rays.low(), size = scene.rays.high() - low;
    const float along = 0.3f + 0.4f * float(number) / float(frames);
    return {low + glm::vec3(along, 0.5f, 0.5f) * size};
}

/// Processor time of a frame by links that are kept [ms], until converged.
double frame_by_links(const SolveScene& scene, int frames)
{
    LiveLinks live(copy_of(scene), {});
    live.settle();
    Stopwatch watch;
    watch.start();
    for (int number = 1; number <= frames; ++number) {
        live.move_lamp(kLamp,
                       glm::translate(glm::mat4(1.0f), glm::vec3(lamp_at(scene, number, frames))));
        live.settle();
    }
    watch.stop();
    return 1e3 * watch.cpu / frames;
}

struct Frame {
    Stopwatch emission, transfer, map, picture;
};

}  // namespace

void add_frame(Report& report, const gpu::Device& device, const MatrixSpeedSettings& settings)
{
    const BakeOptions options = bake_options(settings, device);
    const ProgressFunction nobody;
    Stages stages(nobody);
    const Setting setting(scene_with_lamp(settings.shared), &device, options, stages);
    const SolveScene& scene = setting.prepared;
    const auto solution = solve_sources(device, setting, options, stages);
    std::vector<std::uint32_t> numbers(scene.lumels.lumels.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    RelightSession session(device, *solution->relightable);
    const World lit(device, scene.scene, scene.lumels, &scene.atlas);
    session.set_world({lit, scene.lumels, numbers, {}});
    const View view = choose_view(scene.scene, scene.rays);
    Preview preview(device, scene.scene, scene.atlas);

    Frame frame;
    for (int number = 0; number <= settings.repeats; ++number) {
        Frame next;
        session.move_light(kLamp, {.position = lamp_at(scene, number, settings.repeats)});
        next.emission.start();
        session.irradiance();
        next.emission.stop();
        next.transfer.start();
        const std::vector<glm::vec3> light = session.irradiance();
        next.transfer.stop();
        next.map.start();
        const Image map = finish_map(scene.scene, scene.atlas, scene.lumels, light);
        next.map.stop();
        next.picture.start();
        preview.draw(scene.scene, map, view, kWidth);
        next.picture.stop();
        if (number == 0)  // the driver compiles what it meets for the first time
            continue;
        for (Stopwatch Frame::*part :
             {&Frame::emission, &Frame::transfer, &Frame::map, &Frame::picture}) {
            (frame.*part).cpu += (next.*part).cpu;
            (frame.*part).wall += (next.*part).wall;
        }
    }
    // A frame with a moved lamp does what one without does.
    frame.emission.cpu -= frame.transfer.cpu;
    frame.emission.wall -= frame.transfer.wall;

    report.table("frame",
                 fmt::format("A frame in which a lamp moves ([SF17] sections 3.6 and 4.3): {}, {} "
                             "lumels, {} patches, a picture {} pixels wide",
                             settings.shared.scene, session.size(), session.light().patches.size(),
                             kWidth),
                 {"step", "cpu ms", "wall ms", "ms"},
                 fmt::format("whole frame, {:.2f} ms", frame_by_links(scene, settings.repeats)));
    const bool by_processor = counts_processor_time(device);
    Stopwatch all;
    const auto add = [&](const char* name, const Stopwatch& time) {
        const double cpu = 1e3 * time.cpu / settings.repeats;
        const double wall = 1e3 * time.wall / settings.repeats;
        report.row({name, fixed(cpu, 2), fixed(wall, 2), fixed(by_processor ? cpu : wall, 2)});
        all.cpu += time.cpu;
        all.wall += time.wall;
    };
    add("shadow maps and emission (1, 2)", frame.emission);
    add("multiply and light of lumels (3, 4)", frame.transfer);
    add("lumels to a map", frame.map);
    add("picture (5)", frame.picture);
    const Stopwatch whole = all;
    add("whole frame", whole);
}

}  // namespace lumel::bench
