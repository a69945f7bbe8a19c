#include "viewer/session/player.h"

#include <algorithm>
#include <filesystem>

#include <glm/trigonometric.hpp>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/core/log.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "viewer/session/save.h"

namespace lumel {
namespace {

constexpr std::chrono::milliseconds kLook(20);  ///< between checks of a solve

glm::vec3 vector_of(const std::vector<double>& numbers)
{
    glm::vec3 vector(0.0f);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        vector[int(i)] = float(numbers[i]);
    return vector;
}

/// One factor for all channels, or one each.
glm::vec3 colour_of(const std::vector<double>& numbers)
{
    return numbers.size() == 1 ? glm::vec3(float(numbers[0])) : vector_of(numbers);
}

float radians_of(const std::vector<double>& degrees, std::size_t i)
{
    return i < degrees.size() ? float(glm::radians(degrees[i])) : 0.0f;
}

ViewMode mode_of(const std::string& name)
{
    const auto found = std::find(kViewModes.begin(), kViewModes.end(), name);
    return ViewMode(found - kViewModes.begin());
}

}  // namespace

ScriptPlayer::ScriptPlayer(std::vector<ScriptCommand> script, std::string path,
                           ViewSession& session, OutputFolder& output, std::string folder,
                           std::function<Image()> window)
    : script_(std::move(script)),
      path_(std::move(path)),
      session_(&session),
      output_(&output),
      folder_(std::move(folder)),
      window_(std::move(window))
{
}

void ScriptPlayer::step()
{
    while (!done()) {
        const ScriptCommand& command = script_[next_];
        try {
            if (!play(command))
                return;
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::input)
                throw;
            throw Error(ErrorKind::input, line_of(path_, command.line), error.what());
        }
    }
}

/// Executes a command. Returns false after a frame of light, or while a method solves.
bool ScriptPlayer::play(const ScriptCommand& command)
{
    switch (command.form->verb) {
    case Verb::frames:
        session_->frame();
        if (++frames_ == int(command.numbers[0])) {
            frames_ = 0;
            ++next_;
        }
        return false;
    case Verb::wait:
        if (session_->is_baking() || session_->frame().at_rest)
            next_ += session_->bake(kLook) ? 1 : 0;
        return false;
    case Verb::solve:
        if (!solve(command))
            return false;
        ++next_;
        return true;
    case Verb::quit:
        quit_ = true;
        next_ = script_.size();
        return true;
    default:
        if (!write(command)) {
            look(command);
            handle(command);
            light(command);
            show(command);
        }
        ++next_;
        return true;
    }
}

/// Returns true once the light is there.
bool ScriptPlayer::solve(const ScriptCommand& command)
{
    if (!solving_)
        solving_ = std::make_unique<SolveAside>(*session_, command.solver);
    if (!solving_->has_ended(kLook))
        return false;
    const std::unique_ptr<SolveAside> ended = std::move(solving_);
    try {
        SolvedLight light = ended->take();
        for (const std::string& warning : light.warnings)
            log_warning(warning);
        if (!session_->take_solved(std::move(light), ended->edits()))
            log_warning("the scene was changed during the solve: showing the light of links");
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::stopped)
            throw;
        log_warning(error.what());
    }
    return true;
}

void ScriptPlayer::stop_solving()
{
    if (solving_)
        solving_->stop();
}

/// Returns true if the command writes a file.
bool ScriptPlayer::write(const ScriptCommand& command)
{
    switch (command.form->verb) {
    case Verb::picture:
        write_png(output_->path(command.text), session_->picture());
        break;
    case Verb::window:
        write_png(output_->path(command.text), window_());
        break;
    case Verb::save:
        save_bake(*session_, (std::filesystem::path(folder_) / command.text).string());
        break;
    case Verb::state:
        write_json(output_->path(command.text), state_of(*session_));
        break;
    default:
        return false;
    }
    files_.push_back(command.text);
    return true;
}

void ScriptPlayer::look(const ScriptCommand& command)
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

void ScriptPlayer::handle(const ScriptCommand& command)
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

void ScriptPlayer::light(const ScriptCommand& command)
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

void ScriptPlayer::show(const ScriptCommand& command)
{
    const std::vector<double>& n = command.numbers;
    switch (command.form->verb) {
    case Verb::exposure:
        return session_->set_exposure(n.empty() ? std::nullopt : std::optional<float>(float(n[0])));
    case Verb::stops:
        return session_->step_exposure(float(n[0]));
    case Verb::mode:
        return session_->set_mode(mode_of(command.text));
    case Verb::probes:
        return session_->set_probes(n.empty() ? 0.0 : n[0]);
    case Verb::light:
        return session_->show_solved(command.text == "solved");
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

std::vector<ScriptCommand> script_of(const std::string& path)
{
    const Bytes bytes = read_file(path, path);
    return read_script({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

}  // namespace lumel
