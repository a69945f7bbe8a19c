#pragma once
// Mouse and keys of the window.

#include <optional>
#include <span>

#include "viewer/session/session.h"
#include "viewer/window/screen.h"
#include "viewer/window/ui_state.h"

namespace lumel {

/// A line of the help box.
struct KeyHelp {
    const char *keys, *meaning;
};
std::span<const KeyHelp> key_help();

class Controls {
public:
    /// Executes mouse and key input since the last frame, except input to widgets.
    void act(ViewSession& session, UiState& desk, Screen& screen);

private:
    enum class Drag { none, look, orbit, thing };

    void press(const KeyPress& press, ViewSession& session, UiState& desk, Screen& screen);
    void hold(ViewSession& session, UiState& desk, const Screen& screen);
    void mouse(ViewSession& session, UiState& desk);
    void drag(ViewSession& session, UiState& desk);
    Drag begin_drag(ViewSession& session, const UiState& desk);
    void move_thing(ViewSession& session, const UiState& desk);

    Drag drag_ = Drag::none;
    glm::vec3 grip_{0.0f};  ///< point of the object under the mouse [m]
};

}  // namespace lumel
