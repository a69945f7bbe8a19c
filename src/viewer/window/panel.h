#pragma once
// The panel at the right of the window, and its help box.

#include "viewer/session/session.h"
#include "viewer/window/ui_state.h"

namespace lumel {

/// Draws it, and does what it is asked for.
void show_panel(ViewSession& session, UiState& desk);

/// The legend of false colours in a box that can be moved, for windows without a panel.
void show_legend(ViewSession& session);

/// The box of keys, over the picture.
void show_help(UiState& desk);

/// A line at the bottom of the picture.
void show_line(const std::string& text, const UiState& desk);

}  // namespace lumel
