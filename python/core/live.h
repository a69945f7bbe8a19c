#pragma once
// What the live classes share.

#include <algorithm>

#include "calls.h"

namespace lumel_python {

/// Time between two checks for Ctrl-C [ms]: too short for a person to notice.
inline constexpr double kSlice = 100.0;

/// Runs update() of a live class for about `budget_ms`, and handles signals.
template <class Live, class State>
State update_in_slices(Live& live, double budget_ms)
{
    if (!(budget_ms >= 0.0))
        throw py::value_error("budget_ms must be a number from 0 up");
    return result_of<State>([&] {
        State state;
        double spent = 0.0;
        do {
            state = live.update(std::min(kSlice, budget_ms - spent));
            spent += state.milliseconds;
            check_signals();
        } while (!state.at_rest && spent < budget_ms);
        state.milliseconds = spent;
        return state;
    });
}

}  // namespace lumel_python
