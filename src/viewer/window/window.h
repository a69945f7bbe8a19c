#pragma once
// The window of lumel view.

#include "viewer/session/view.h"

namespace lumel {

/// Opens a window on a scene, lights it progressively, and plays the script if there is one.
/// Returns when the window is closed, or the script quits. Throws Error{device} if no window can be
/// opened, and as play_script() does.
ViewSummary show_window(const ScriptRun& run, const SessionOptions& options,
                        const ProgressFunction& progress = {});

}  // namespace lumel
