#include "view/view.h"

#include <optional>

#include <glm/trigonometric.hpp>

#include "bake/setting.h"
#include "bake/stages.h"
#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "images/image_files.h"
#include "output/folder.h"
#include "view/script.h"
#include "json/json_file.h"

namespace lumel {
namespace {

glm::vec3 vector_of(const std::vector<double>& numbers)
{
    glm::vec3 vector(0.0f);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        vector[int(i)] = float(numbers[i]);
    return vector;
}

/// A factor for all channels, or one for each.
glm::vec3 colour_of(const std::vector<double>& numbers)
{
    return numbers.size() == 1 ? glm::vec3(float(numbers[0])) : vector_of(numbers);
}

float radians_of(const std::vector<double>& degrees, std::size_t i)
{
    return i < degrees.size() ? float(glm::radians(degrees[i])) : 0.0f;
}

ViewMode mode_of(const std::string& word)
{
    if (word == "lit")
        return ViewMode::lit;
    return word == "irradiance" ? ViewMode::irradiance : ViewMode::lumels;
}

/// Does what a script says.
class Player {
public:
    Player(ViewSession& session, OutputFolder& output, Stages& stages)
        : session_(&session),
          output_(&output),
          stages_(&stages)
    {
    }

    /// False if it was stopped.
    bool play(const ScriptCommand& command)
    {
        switch (command.form->verb) {
        case Verb::frames:
            return frames(int(command.numbers[0]));
        case Verb::wait:
            return wait();
        case Verb::picture:
            write_png(output_->path(command.text), session_->picture());
            files_.push_back(command.text);
            return true;
        case Verb::state:
            write_json(output_->path(command.text), state_of(*session_));
            files_.push_back(command.text);
            return true;
        default:
            look(command);
            handle(command);
            light(command);
            show(command);
            return true;
        }
    }

    const std::vector<std::string>& files() const { return files_; }

private:
    void look(const ScriptCommand& command)
    {
        const std::vector<double>& n = command.numbers;
        ViewCamera& camera = session_->camera();
        switch (command.form->verb) {
        case Verb::camera:
            return session_->take_camera(int(n[0]));
        case Verb::eye:
            return camera.set_eye(vector_of(n));
        case Verb::look:
            return camera.look_at(vector_of(n));
        case Verb::walk:
            return camera.walk(vector_of(n));
        case Verb::gaze:
            return camera.gaze(radians_of(n, 0), radians_of(n, 1));
        case Verb::orbit:
            return session_->orbit(radians_of(n, 0), radians_of(n, 1));
        default:
            return;
        }
    }

    void handle(const ScriptCommand& command)
    {
        const std::vector<double>& n = command.numbers;
        switch (command.form->verb) {
        case Verb::pick:
            return n.empty() ? session_->pick(command.text)
                             : session_->pick(glm::ivec2(int(n[0]), int(n[1])));
        case Verb::move:
            return session_->move(vector_of(n));
        case Verb::turn:
            return session_->turn(radians_of(n, 0));
        case Verb::remove:
            return session_->remove();
        case Verb::paint:
            return session_->paint(vector_of(n));
        default:
            return;
        }
    }

    void light(const ScriptCommand& command)
    {
        const std::vector<double>& n = command.numbers;
        switch (command.form->verb) {
        case Verb::dim:
            return session_->dim(colour_of(n));
        case Verb::lamp:
            return session_->set_lamp(command.text, colour_of(n));
        case Verb::sky:
            return session_->set_sky(colour_of(n));
        case Verb::turn_sky:
            return session_->turn_sky(glm::radians(n[0]));
        case Verb::sun:
            return session_->set_sun({glm::radians(n[0]), glm::radians(n[1])});
        case Verb::time:
            return session_->set_time(n[0]);
        default:
            return;
        }
    }

    void show(const ScriptCommand& command)
    {
        const std::vector<double>& n = command.numbers;
        switch (command.form->verb) {
        case Verb::exposure:
            return session_->set_exposure(n.empty() ? std::nullopt
                                                    : std::optional<float>(float(n[0])));
        case Verb::stops:
            return session_->step_exposure(float(n[0]));
        case Verb::mode:
            return session_->set_mode(mode_of(command.text));
        case Verb::scale:
            if (n.empty())
                return session_->set_scale(std::nullopt);
            if (!(n[0] < n[1]))
                throw Error(ErrorKind::input, "", "scale takes the lower end first");
            return session_->set_scale(LuxScale{.low = n[0], .high = n[1]});
        default:
            return;
        }
    }

    bool frames(int count)
    {
        for (int frame = 0; frame < count; ++frame) {
            if (!go_on())
                return false;
            session_->frame();
        }
        return true;
    }

    bool wait()
    {
        do {
            if (!go_on())
                return false;
        } while (!session_->frame().at_rest);
        return true;
    }

    bool go_on() { return stages_->progress(0.0); }

    ViewSession* session_;
    OutputFolder* output_;
    Stages* stages_;
    std::vector<std::string> files_;
};

std::vector<ScriptCommand> script_of(const std::string& path)
{
    const Bytes bytes = read_file(path, path);
    return read_script({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

/// The animation of a file, if the script comes to it.
Animation animation_for(const std::vector<ScriptCommand>& script, const ScriptRun& run,
                        const SessionOptions& options)
{
    for (const ScriptCommand& command : script)
        if (command.form->verb == Verb::time)
            return read_animation(run.scene, options.animation);
    return {};
}

/// True if it came to its end.
bool play_all(const std::vector<ScriptCommand>& script, Player& player, const std::string& path)
{
    for (const ScriptCommand& command : script)
        try {
            if (!player.play(command))
                return false;
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::input)
                throw;
            throw Error(ErrorKind::input, place_of(path, command.line), error.what());
        }
    return true;
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

ViewSummary play_script(const ScriptRun& run, const SessionOptions& options,
                        const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    const std::vector<ScriptCommand> script = script_of(run.script);
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
    Player player(session, output, stages);
    if (!play_all(script, player, run.script))
        throw Error(ErrorKind::stopped, "",
                    "stopped before the end of the script; nothing is written");
    Json report;
    report["scene"] = run.scene;
    report["files"] = player.files();
    report["state"] = state_of(session);
    stages.end();
    device.check_validation();
    output.commit();
    return {session.costs().frames, player.files(), stages.seconds(), json_text(report)};
}

}  // namespace lumel
