#pragma once
// Mouse and keys of the window.

#include <optional>
#include <span>

#include "view/session.h"
#include "window/desk.h"
#include "window/screen.h"

namespace lumel {

/// A line of the help box.
struct KeyHelp {
    const char *keys, *meaning;
};
std::span<const KeyHelp> key_help();

class Controls {
public:
    /// Does what mouse and keys ask for, since the frame before. While a widget has them it is left
    /// to the widget.
    void act(ViewSession& session, Desk& desk, Screen& screen);

private:
    enum class Drag { none, look, orbit, thing };

    void press(const KeyPress& press, ViewSession& session, Desk& desk, Screen& screen);
    void hold(ViewSession& session, Desk& desk, const Screen& screen);
    void mouse(ViewSession& session, Desk& desk);
    void drag(ViewSession& session, Desk& desk);
    Drag begin_drag(ViewSession& session, const Desk& desk);
    void move_thing(ViewSession& session, const Desk& desk);

    Drag drag_ = Drag::none;
    glm::vec3 grip_{0.0f};  ///< point of the thing under the mouse [m]
};

}  // namespace lumel
