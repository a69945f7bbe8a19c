// For builds without GLFW or Dear ImGui.

#include "base/core/error.h"
#include "viewer/window/window.h"

namespace lumel {

ViewSummary show_window(const ScriptRun&, const SessionOptions&, const ProgressFunction&)
{
    throw Error(ErrorKind::device, "lumel view",
                "this build has no window, as GLFW or Dear ImGui was missing; --script FILE "
                "--headless works without one");
}

}  // namespace lumel
