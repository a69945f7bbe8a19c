#pragma once
// The window of lumel view.

#include "viewer/session/view.h"

namespace lumel {

/// Opens a window on a scene, which is lit by and by, and plays the script in it if there is one.
/// Ends when the window is closed, or by the script. Throws Error{device} where no window can be
/// opened, and as play_script does.
ViewSummary show_window(const ScriptRun& run, const SessionOptions& options,
                        const ProgressFunction& progress = {});

}  // namespace lumel
