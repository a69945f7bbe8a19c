#include "solve/solver/solver.h"

#include "base/core/usage.h"
#include "methods/options.h"

namespace lumel {

namespace {

bool step_on(Solver& solver, const SolverOptions& options,
             const std::function<bool(const SolverState&)>& go_on,
             const std::function<double()>& given_seconds)
{
    const double start = wall_seconds();
    for (;;) {
        const SolverState state = solver.state();
        const double own_seconds = wall_seconds() - start;
        if (go_on && !go_on(state))
            return false;
        const double seconds = given_seconds ? given_seconds() : own_seconds;
        if (options.max_shots > 0 && state.shots >= options.max_shots)
            return true;
        // Before there is light, an end would be of no use.
        if (options.max_seconds > 0.0 && seconds >= options.max_seconds && state.shots > 0)
            return true;
        const auto met = [](double error, double target) {
            return target <= 0.0 || (error >= 0.0 && error <= target);
        };
        if (options.has_target() && met(state.error, options.target_error) &&
            met(state.dark_error, options.target_dark_error) &&
            met(state.eye_error, options.target_quality.eye_error) &&
            met(state.seen_noise(), options.target_quality.visible_noise))
            return true;
        if (state.full || state.ended)
            return true;
        solver.step();
    }
}

}  // namespace

bool solve(Solver& solver, const SolverOptions& options,
           const std::function<bool(const SolverState&)>& go_on,
           const std::function<double()>& seconds)
{
    const bool is_finished = step_on(solver, options, go_on, seconds);
    solver.release();
    return is_finished;
}

}  // namespace lumel
