#include "viewer/session/view.h"

#include "base/core/error.h"
#include "base/core/log.h"
#include "base/json/json_file.h"
#include "jobs/solve/setting.h"
#include "jobs/solve/stages.h"
#include "results/files/folder.h"
#include "results/preview/view.h"
#include "viewer/session/player.h"

namespace lumel {
namespace {

/// The animation of a file, if the script uses it.
Animation animation_for(const std::vector<ScriptCommand>& script, const ScriptRun& run,
                        const SessionOptions& options)
{
    for (const ScriptCommand& command : script)
        if (command.form->verb == Verb::time)
            return read_animation(run.scene, options.animation);
    return {};
}

/// Throws Error{input} if the script asks for a picture of the window.
void check_needs_no_window(const std::vector<ScriptCommand>& script, const std::string& path)
{
    for (const ScriptCommand& command : script)
        if (command.form->verb == Verb::window)
            throw Error(ErrorKind::input, line_of(path, command.line),
                        "there is no window with --headless; \"picture\" needs none");
}

}  // namespace

Scene scene_to_view(const std::string& path, const Animation& animation,
                    const SessionOptions& options)
{
    Scene scene = read_gltf(path);
    add_lights(scene, options.lights);
    check_camera(scene, options.camera);
    scene.warnings.insert(scene.warnings.end(), animation.warnings.begin(),
                          animation.warnings.end());
    if (!animation.nodes.empty())
        pose(scene, animation, 0.0);
    return scene;
}

View first_view(const Scene& scene, int camera)
{
    if (camera >= 0)
        return view_of(scene.cameras.at(std::size_t(camera)));
    return scene.cameras.empty() ? choose_view(scene, RayScene(scene))
                                 : view_of(scene.cameras.front());
}

void throw_stopped_script()
{
    throw Error(ErrorKind::stopped, "", "stopped before the end of the script; nothing is written");
}

ViewSummary summary_of(const std::string& scene, ViewSession& session,
                       const std::vector<std::string>& files, double seconds)
{
    Json report;
    report["scene"] = scene;
    report["files"] = files;
    report["state"] = state_of(session);
    return {session.costs().frames, files, seconds, json_text(report)};
}

ViewSummary play_script(const ScriptRun& run, const SessionOptions& options,
                        const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    std::vector<ScriptCommand> script = script_of(run.script);
    check_needs_no_window(script, run.script);
    const Animation animation = animation_for(script, run, options);
    Scene scene = scene_to_view(run.scene, animation, options);
    OutputFolder output(run.folder);
    const gpu::Device device(options.device);
    stages.watch(device);
    tell_warnings(scene);

    stages.begin("tracing");
    ViewSession session(device, std::move(scene), animation, options);
    for (const std::string& note : session.light().atlas().notes)
        log_info(note);
    stages.begin("playing");
    if (options.solver)
        script.insert(script.begin(), solve_command(*options.solver));
    ScriptPlayer player(std::move(script), run.script, session, output, run.folder);
    while (!player.done()) {
        if (!stages.progress(0.0))
            throw_stopped_script();
        player.step();
    }
    stages.end();
    device.check_validation();
    output.commit();
    return summary_of(run.scene, session, player.files(), stages.seconds());
}

}  // namespace lumel
