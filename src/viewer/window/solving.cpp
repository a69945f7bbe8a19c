#include "viewer/window/solving.h"

#include <utility>

#include <fmt/format.h>

#include "base/core/log.h"
#include "jobs/solve/stages.h"

namespace lumel {
namespace {

constexpr double kInPercent = 100.0;

}  // namespace

void Solving::begin(const ViewSession& session, const SolverOptions& options)
{
    drop();
    aside_ = std::make_unique<SolveAside>(session, options);
}

void Solving::take(ViewSession& session, UiState& desk)
{
    const std::unique_ptr<SolveAside> ended = std::move(aside_);
    if (ended->edits() != session.edits()) {
        desk.message = "the scene was changed: the solve is cancelled";
        return;
    }
    SolvedLight light = ended->take();
    desk.message.clear();
    for (const std::string& warning : light.warnings) {
        log_warning(warning);
        desk.message = warning;
    }
    session.take_solved(std::move(light), ended->edits());
    desk.changed = true;
}

void Solving::follow(ViewSession& session, UiState& desk)
{
    const bool begins = std::exchange(desk.solve_by, false),
               stops = std::exchange(desk.stop, false);
    if (begins && !aside_) {
        SolverOptions options{.method = desk.method.options()};
        options.target_error = double(desk.error) / kInPercent;
        desk.message.clear();
        begin(session, options);
    }
    if (aside_ && (stops || aside_->edits() != session.edits()))
        aside_->stop();
    if (aside_ && aside_->has_ended(std::chrono::milliseconds(0)))
        take(session, desk);
    note_progress(aside_.get(), desk);
}

void note_progress(const SolveAside* solving, UiState& desk)
{
    desk.solving.clear();
    if (!solving)
        return;
    const BakeProgress now = solving->progress();
    desk.solved_part = float(now.fraction);
    const MethodInfo& method = method_of(solving->options().method);
    desk.solving = fmt::format("{}: {}", method.id, now.stage);
    if (now.shots > 0)
        desk.solving += fmt::format(", {} {}", now.shots, method.shots);
    if (now.error >= 0.0)
        desk.solving += ", error " + percent_text(now.error);
}

}  // namespace lumel
