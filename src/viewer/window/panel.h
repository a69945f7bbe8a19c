#pragma once
// The window's panel at the right, and its help box.

#include "viewer/session/session.h"
#include "viewer/window/ui_state.h"

namespace lumel {

/// Draws the panel, and applies its input.
void show_panel(ViewSession& session, UiState& desk);

/// Legend of false colours in a movable box, for windows without a panel.
void show_legend(ViewSession& session);

/// Help on keys, over the image.
void show_help(UiState& desk);

/// A line at the bottom of the image.
void show_line(const std::string& text, const UiState& desk);

}  // namespace lumel
