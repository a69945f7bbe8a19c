#pragma once
// The panel at the right of the window, and its help box.

#include "view/session.h"
#include "window/desk.h"

namespace lumel {

/// Draws it, and does what it is asked for.
void show_panel(ViewSession& session, Desk& desk);

/// The legend of false colours in a box that can be moved, for windows without a panel.
void show_legend(ViewSession& session);

/// The box of keys, over the picture.
void show_help(Desk& desk);

/// A line at the bottom of the picture.
void show_line(const std::string& text, const Desk& desk);

}  // namespace lumel
